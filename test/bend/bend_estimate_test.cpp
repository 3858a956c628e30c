// SPDX-License-Identifier: BSD-3-Clause
#include "bend/bend_estimate.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <functional>

namespace cabinet_articulation::core {
namespace {

const cv::Size kSize(160, 120);

/// Views of parts of an image of residuals, each with its noise [px] on windows of 15 px, and what `more` adds.
std::vector<BendView> viewsOf(const BendVector& bend, int count, double noise,
                              const std::function<double(int i, int u, int v)>& more = {}) {
  cv::RNG random(7);
  const BendBasis basis(kSize);
  cv::Mat1f image;
  basis.draw(bend, &image);
  BendSurvey survey;
  std::vector<BendView> views;
  for (int i = 0; i < count; ++i) {
    const cv::Rect part(random.uniform(0, 60), random.uniform(0, 40), random.uniform(60, 100), random.uniform(50, 80));
    cv::Mat1f windows(kSize.height / 15, kSize.width / 15 + 1);
    random.fill(windows, cv::RNG::NORMAL, 0, noise);
    cv::Mat1f disparity = image + 20;
    for (int v = 0; v < kSize.height; ++v)
      for (int u = 0; u < kSize.width; ++u)
        disparity(v, u) += windows(v / 15, u / 15) + (more ? static_cast<float>(more(i, u, v)) : 0);
    PlaneRegion region;
    region.disparity_plane.c = 20;
    region.mask = cv::Mat1b(kSize, std::uint8_t{kFree});
    region.mask(part).setTo(kInPlane);
    region.inliers = part.area();
    region.hull = {cv::Point2f(part.tl()), cv::Point2f(part.br().x, part.y), cv::Point2f(part.br()),
                   cv::Point2f(part.x, part.br().y)};
    views.push_back(*survey.process(disparity, region));
  }
  return views;
}

BendVector exampleBend() {
  BendVector bend;
  bend << 0.4, -0.2, 0.3, 0.1, 0, -0.1, 0.05, 0, 0.1, 0, 0, -0.1;
  return bend;
}

double errorOf(const BendVector& found) { return (found - exampleBend()).norm() / exampleBend().norm(); }

TEST(BendEstimate, FindsABendThatAllViewsShare) {
  EXPECT_LT(errorOf(estimateBend(viewsOf(exampleBend(), 200, 0.05)).bend), 0.1);
  EXPECT_LT(errorOf(estimateBend(viewsOf(exampleBend(), 60, 0)).bend), 0.01);
}

TEST(BendEstimate, SaysHowFarItMayBeWrong) {
  const BendEstimate few = estimateBend(viewsOf(exampleBend(), 60, 0.2)), many = estimateBend(viewsOf(exampleBend(), 200, 0.2));
  EXPECT_LT(many.covariance.trace(), few.covariance.trace());
  for (const BendEstimate& found : {few, many}) {
    const BendVector error = found.bend - exampleBend();
    const double squared = error.dot(found.covariance.llt().solve(error));
    EXPECT_LT(squared, 32.9) << "as chi-squared of 12 degrees of freedom, but once in a thousand times";
  }
}

TEST(BendEstimate, FewViewsTellNothing) { EXPECT_TRUE(estimateBend(viewsOf(exampleBend(), 47, 0.02)).bend.isZero(0)); }

TEST(BendEstimate, NoiseIsNoBend) {
  for (const int count : {48, 60, 100, 200})
    EXPECT_TRUE(estimateBend(viewsOf(BendVector::Zero(), count, 0.2)).bend.isZero(0)) << count << " views";
}

/// A fold across the image, at another place in each view.
TEST(BendEstimate, AFoldThatMovesIsNoBend) {
  const auto fold = [](int i, int u, int) { return std::max(0, u - (37 * i) % kSize.width) * 0.02; };
  for (const int count : {48, 80, 200}) {
    const BendVector found = estimateBend(viewsOf(BendVector::Zero(), count, 0.05, fold)).bend;
    EXPECT_TRUE(found.isZero(0)) << count << " views: " << found.transpose();
  }
}

TEST(BendEstimate, ViewsOfBentSurfacesDoNotSpoilTheOthers) {
  const auto bowl = [](int i, int u, int) { return i % 5 == 0 ? (u - 80.0) * (u - 80.0) * 3e-4 : 0; };
  EXPECT_LT(errorOf(estimateBend(viewsOf(exampleBend(), 200, 0.05, bowl)).bend), 0.1);
}

}  // namespace
}  // namespace cabinet_articulation::core
