// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/refit/depth_refit.h"

#include <gtest/gtest.h>

#include <random>

#include "front_scene.h"

namespace cabinet_articulation::core {
namespace {

/// A front as a depth camera sees it, and a candidate for it whose plane is turned about its upright axis.
class DepthRefitTest : public testing::Test {
 protected:
  DepthRefitTest() : frame_{exampleCamera(), {}, {}, {}}, region_(frontRegion(front_, frame_.camera)) {
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 0.1);  // [px]
    frame_.disparity = cv::Mat1f(frame_.camera.height, frame_.camera.width, 0.0F);
    for (int v = 0; v < frame_.camera.height; ++v)
      for (int u = 0; u < frame_.camera.width; ++u)
        if (region_.mask(v, u) == kInPlane)
          frame_.disparity(v, u) = static_cast<float>(region_.disparity_plane.at(u, v) + noise(random));
  }

  RectangleCandidate turned() const {
    Rectangle wrong = front_;
    wrong.pose.linear() *= Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY()).toRotationMatrix();
    PlaneRegion region = region_;
    region.plane = wrong.plane();
    region.disparity_plane = *toDisparityPlane(wrong.plane(), frame_.camera);
    const PlaneChart chart = *PlaneChart::at(region.plane, frame_.camera, frame_.camera.project(front_.center()));
    return {0, region, chart, chart.fromSpace(wrong), false};
  }

  double tilt(const RectangleCandidate& candidate) const {
    return std::acos(std::min(1.0, candidate.chart.toSpace(candidate.rectangle).normal().dot(front_.normal())));
  }

  const Rectangle front_ = exampleFront({0, 0, 1.4}, 0.4, 0.3, 0.3, 0.2, 0);
  DepthFrame frame_;
  PlaneRegion region_;
};

TEST_F(DepthRefitTest, PutsAWrongPlaneRight) {
  RectangleCandidate candidate = turned();
  ASSERT_GT(tilt(candidate), 0.09);
  ASSERT_TRUE(refitByDepth(frame_, &candidate));
  EXPECT_LT(tilt(candidate), 0.005);
  EXPECT_LT((candidate.region.plane.normal - front_.normal()).norm(), 0.005);
}

TEST_F(DepthRefitTest, LooksAtWhatBelongsToTheNeighboursRegion) {
  const Eigen::Vector2d middle = frame_.camera.project(front_.center());
  region_.mask(cv::Rect(0, 0, static_cast<int>(middle.x()), region_.mask.rows)).setTo(kOtherPlane);
  RectangleCandidate candidate = turned();
  ASSERT_TRUE(refitByDepth(frame_, &candidate));
  EXPECT_LT(tilt(candidate), 0.005) << "half of the front would tell it half as well";
}

TEST_F(DepthRefitTest, LeavesOutAHandle) {
  const Eigen::Vector2d handle = frame_.camera.project(front_.pose * Eigen::Vector3d(0.15, 0, 0));
  const cv::Rect bar(static_cast<int>(handle.x()) - 5, static_cast<int>(handle.y()) - 30, 10, 60);
  for (float& disparity : frame_.disparity(bar)) disparity += 1.2F;  // 4 cm
  RectangleCandidate candidate = turned();
  ASSERT_TRUE(refitByDepth(frame_, &candidate));
  EXPECT_LT(tilt(candidate), 0.005);
}

TEST_F(DepthRefitTest, ChangesNothingWithoutDepth) {
  frame_.disparity.setTo(0);
  RectangleCandidate candidate = turned();
  EXPECT_FALSE(refitByDepth(frame_, &candidate));
  EXPECT_GT(tilt(candidate), 0.09);
}

}  // namespace
}  // namespace cabinet_articulation::core
