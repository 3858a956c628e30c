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

TEST_F(DepthRefitTest, AFrameAroundAHoleIsEnough) {
  Rectangle hole = front_;
  hole.width *= 0.8;
  hole.height *= 0.8;
  region_.mask.setTo(kHole, footprint(hole, frame_.camera));
  RectangleCandidate candidate = turned();
  ASSERT_TRUE(refitByDepth(frame_, &candidate)) << "36 % of the rectangle, but all of the front";
  EXPECT_LT(tilt(candidate), 0.005);
}

TEST_F(DepthRefitTest, ChangesNothingWhereDepthIsSparse) {
  std::mt19937 random(2);
  std::bernoulli_distribution is_lost(0.6);
  for (float& disparity : frame_.disparity)
    if (is_lost(random)) disparity = 0;
  RectangleCandidate candidate = turned();
  EXPECT_FALSE(refitByDepth(frame_, &candidate));
  EXPECT_GT(tilt(candidate), 0.09);
}

TEST_F(DepthRefitTest, ATracksSizeMovesNoEdgeAtACrease) {
  for (const Edge edge : kEdges) {
    RectangleCandidate candidate = turned();
    candidate.guided = true;
    const PlaneRectangle refined = candidate.rectangle;
    HiddenBehind hidden;
    hidden[edge] = 0.01;
    const PlaneRectangle tracked{candidate.rectangle.center, candidate.rectangle.angle, 0.43, 0.33};  // 3 cm more are hidden
    candidate.rectangle = tracked;
    const ImageEdge before = *imageEdge(candidate.chart, refined, edge);
    ASSERT_TRUE(refitAtCrease(refined, hidden, frame_, &candidate));
    EXPECT_LT(tilt(candidate), 0.005) << edge;
    EXPECT_NEAR(candidate.rectangle.width, tracked.width, 1e-9) << edge;
    EXPECT_NEAR(candidate.rectangle.height, tracked.height, 1e-9) << edge;
    const ImageEdge after = *imageEdge(candidate.chart, candidate.rectangle, edge);
    const Eigen::Vector2d moved = (after.a + after.b - before.a - before.b) / 2;
    // A rectangle of another plane has the same corners to within some pixels only; 1.5 cm are 7 px.
    EXPECT_LT(std::abs(moved.dot(before.outward)), 2) << edge;
  }
}

TEST_F(DepthRefitTest, ChangesNothingWithoutACrease) {
  RectangleCandidate candidate = turned();
  EXPECT_FALSE(refitAtCrease(candidate.rectangle, {}, frame_, &candidate));
  EXPECT_GT(tilt(candidate), 0.09);
}

TEST_F(DepthRefitTest, ChangesNothingWithoutDepth) {
  frame_.disparity.setTo(0);
  RectangleCandidate candidate = turned();
  EXPECT_FALSE(refitByDepth(frame_, &candidate));
  EXPECT_GT(tilt(candidate), 0.09);
}

}  // namespace
}  // namespace cabinet_articulation::core
