// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/refit/plane_refit.h"

#include <gtest/gtest.h>

#include "front_scene.h"

namespace cabinet_articulation::core {
namespace {

class PlaneRefitTest : public testing::Test {
 protected:
  /// A candidate on a plane that is turned by 9 degrees and moved by 4 mm against the front's.
  RectangleCandidate wrongCandidate() const {
    Rectangle wrong = front_;
    wrong.pose.linear() *= Eigen::AngleAxisd(0.15, Eigen::Vector3d(1, 1, 0).normalized()).toRotationMatrix();
    wrong.pose.translation().z() += 0.004;
    PlaneRegion region = frontRegion(front_, frame_.camera);
    region.plane = wrong.plane();
    region.disparity_plane = *toDisparityPlane(wrong.plane(), frame_.camera);
    const PlaneChart chart = *PlaneChart::at(region.plane, frame_.camera, frame_.camera.project(front_.center()));
    return {0, region, chart, chart.fromSpace(wrong), false};
  }

  static double tilt(const Rectangle& a, const Rectangle& b) { return std::acos(std::min(1.0, a.normal().dot(b.normal()))); }

  const Rectangle front_ = exampleFront({0, 0, 1.4}, 0.3, 0.15, 0.3, 0.2, 0.1);
  const Rectangle wall_ = exampleFront({0, 0, 1.8}, 3, 3, 0, 0, 0);
  DepthFrame frame_{exampleCamera(), {}, {}, {}};
};

TEST_F(PlaneRefitTest, PutsAWrongPlaneRightAndKeepsTheOutline) {
  frame_.left = renderView({{front_, 1}, {wall_, 2}}, frame_.camera, false);
  frame_.right = renderView({{front_, 1}, {wall_, 2}}, frame_.camera, true);
  frame_.disparity = cv::Mat1f(frame_.left.size(), std::numeric_limits<float>::quiet_NaN());
  std::vector<RectangleCandidate> candidates{wrongCandidate()};
  ASSERT_GT(tilt(candidates[0].chart.toSpace(candidates[0].rectangle), front_), 0.14);
  PlaneRefit({}).process(frame_, &candidates);
  const Rectangle result = candidates[0].chart.toSpace(candidates[0].rectangle);
  EXPECT_LT(tilt(result, front_), 0.02);  // 1 degree; four samples a pixel make a coarse picture
  EXPECT_LT((candidates[0].region.plane.normal - front_.normal()).norm(), 0.02);
  EXPECT_LT(cornerError(front_, result), 0.012);  // the start's outline was that of the turned rectangle
}

TEST_F(PlaneRefitTest, GoesAsFarAsThePlanesSettingsAllow) {
  frame_.left = renderView({{front_, 1}, {wall_, 2}}, frame_.camera, false);
  frame_.right = renderView({{front_, 1}, {wall_, 2}}, frame_.camera, true);
  frame_.disparity = cv::Mat1f(frame_.left.size(), std::numeric_limits<float>::quiet_NaN());
  const auto tiltWith = [&](const PlanesConfig& planes) {
    std::vector<RectangleCandidate> candidates{wrongCandidate()};
    PlaneRefit(planes).process(frame_, &candidates);
    return tilt(candidates[0].chart.toSpace(candidates[0].rectangle), front_);
  };
  const double refined = tiltWith({});
  PlanesConfig one_step, short_way, few_pixels;
  one_step.refine_iterations = 1;
  short_way.refine_max_shift = 0.01;
  few_pixels.refine_pixels = 100;
  EXPECT_GT(tiltWith(one_step), 2 * refined);
  EXPECT_NEAR(tiltWith(short_way), 0.15, 1e-6) << "the plane stays where it was";
  EXPECT_NE(tiltWith(few_pixels), refined);
}

TEST_F(PlaneRefitTest, ChangesNothingWithoutImages) {
  std::vector<RectangleCandidate> candidates{wrongCandidate()};
  const Rectangle before = candidates[0].chart.toSpace(candidates[0].rectangle);
  PlaneRefit({}).process(frame_, &candidates);
  EXPECT_EQ(candidates[0].chart.toSpace(candidates[0].rectangle).pose.matrix(), before.pose.matrix());
}

}  // namespace
}  // namespace cabinet_articulation::core
