// SPDX-License-Identifier: BSD-3-Clause
#include "bend/bend_basis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bend/bend_correction.h"

namespace cabinet_articulation::core {
namespace {

const cv::Size kSize(64, 48);

BendVector term(int i) { return BendVector::Unit(i); }

TEST(BendBasis, TermsAreLegendrePolynomials) {
  const BendBasis basis(kSize);
  const double x = 2 * 10.5 / 64 - 1, y = 2 * 40.5 / 48 - 1;
  const BendVector terms = basis.at(10, 40);
  EXPECT_NEAR(terms[0], (3 * x * x - 1) / 2, 1e-12);
  EXPECT_NEAR(terms[1], x * y, 1e-12);
  EXPECT_NEAR(terms[2], (3 * y * y - 1) / 2, 1e-12);
  EXPECT_NEAR(terms[4], (3 * x * x - 1) / 2 * y, 1e-12);
  EXPECT_NEAR(terms[11], (35 * std::pow(y, 4) - 30 * y * y + 3) / 8, 1e-12);
}

TEST(BendBasis, NoTermIsAPlane) {
  const BendBasis basis(kSize);
  BendVector constant = BendVector::Zero(), slope = BendVector::Zero();
  for (int v = 0; v < kSize.height; ++v)
    for (int u = 0; u < kSize.width; ++u) {
      constant += basis.at(u, v) / kSize.area();
      slope += basis.at(u, v) * ((2 * u + 1.0) / kSize.width - 1) / kSize.area();
    }
  EXPECT_LT(constant.cwiseAbs().maxCoeff(), 2e-3) << "but for the pixels' size";
  EXPECT_LT(slope.cwiseAbs().maxCoeff(), 2e-3);
}

TEST(BendBasis, DrawsWhatItsTermsSay) {
  const BendBasis basis(kSize);
  const BendVector bend = 0.3 * term(0) - 0.2 * term(5) + 0.1 * term(9);
  cv::Mat1f image;
  basis.draw(bend, &image);
  for (int v = 0; v < kSize.height; v += 7)
    for (int u = 0; u < kSize.width; u += 5) EXPECT_NEAR(image(v, u), bend.dot(basis.at(u, v)), 1e-6);
}

class Correction : public testing::Test {
 protected:
  Correction() {
    frame_.disparity = cv::Mat1f(kSize, 20);
    frame_.disparity(3, 4) = 0;
    frame_.disparity(3, 5) = -1;
    frame_.disparity(3, 6) = std::nanf("");
  }
  DepthFrame frame_;
};

TEST_F(Correction, TakesTheBendFromWhatWasMeasured) {
  const BendVector bend = 0.5 * term(1);
  const DepthFrame flat = BendCorrection().process(frame_, bend);
  EXPECT_NEAR(flat.disparity(40, 10), 20 - bend.dot(BendBasis(kSize).at(10, 40)), 1e-5);
  for (int u = 4; u < 7; ++u) EXPECT_FALSE(isValidDisparity(flat.disparity(3, u)));
  EXPECT_EQ(frame_.disparity(40, 10), 20) << "what was measured stays";
}

TEST_F(Correction, NoBendIsTheFrameItself) {
  EXPECT_EQ(BendCorrection().process(frame_, BendVector::Zero()).disparity.data, frame_.disparity.data);
}

TEST_F(Correction, FramesThatAreHeldStay) {
  BendCorrection correction;
  const DepthFrame first = correction.process(frame_, term(0));
  const cv::Mat1f copy = first.disparity.clone();
  for (int i = 0; i < 4; ++i) correction.process(frame_, term(i));
  EXPECT_EQ(cv::norm(copy.row(40), first.disparity.row(40), cv::NORM_INF), 0);
}

}  // namespace
}  // namespace cabinet_articulation::core
