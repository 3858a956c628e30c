// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/edges/edge_refinement.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "front_scene.h"
#include "hinged_door.h"

namespace cabinet_articulation::core {
namespace {

class EdgeRefinementTest : public testing::Test {
 protected:
  void render(const std::vector<TexturedRectangle>& surfaces) {
    frame_.camera = exampleCamera();
    frame_.left = renderView(surfaces, frame_.camera, false);
    frame_.right = renderView(surfaces, frame_.camera, true);
  }

  RefinedRectangle refine(const Rectangle& start) const {
    const PlaneChart chart = *PlaneChart::at(front_.plane(), frame_.camera, frame_.camera.project(front_.center()));
    return refineEdges(chart, frontRegion(front_, frame_.camera), {frame_, {}}, chart.fromSpace(start), {});
  }

  Rectangle inSpace(const PlaneRectangle& rectangle) const {
    return PlaneChart::at(front_.plane(), frame_.camera, frame_.camera.project(front_.center()))->toSpace(rectangle);
  }

  const Rectangle front_ = exampleFront({0, 0, 1.3}, 0.4, 0.13, 0.3, 0.2, 0.1);
  const Rectangle wall_ = exampleFront({0, 0, 1.6}, 3, 3, 0, 0, 0);
  DepthFrame frame_;
};

TEST_F(EdgeRefinementTest, PutsWrongEdgesAndAWrongTurnRight) {
  render({{front_, 1}, {wall_, 2}});
  Rectangle start = front_;
  start.width += 0.014;
  start.height -= 0.008;
  start.pose.translation() += start.pose.linear() * Eigen::Vector3d(0.003, 0.002, 0);
  start.pose.linear() *= Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  ASSERT_GT(cornerError(front_, start), 0.008);
  const RefinedRectangle refined = refine(start);
  for (const bool confirmed : refined.confirmed) EXPECT_TRUE(confirmed);
  // One pixel is 1.9 mm; strips are half a pixel wide.
  EXPECT_LT(cornerError(front_, inSpace(refined.rectangle)), 0.002);
}

TEST_F(EdgeRefinementTest, PlacesEdgesAlikeBeforeLightAndDark) {
  // An open front shades what lies behind it, a closed one does not: edges that depend on it wander as the front opens.
  for (const bool lit : {true, false}) {
    render(lit ? std::vector<TexturedRectangle>{{front_, 1}, {wall_, 2}} : std::vector<TexturedRectangle>{{front_, 1}});
    for (cv::Mat1b* image : {&frame_.left, &frame_.right}) cv::GaussianBlur(*image, *image, {}, 0.6);
    Rectangle start = front_;
    start.width += 0.004;
    start.pose.linear() *= Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const Rectangle seen = inSpace(refine(start).rectangle);
    // One pixel is 1.9 mm.
    EXPECT_NEAR(seen.width, front_.width, 0.0013) << lit;
    EXPECT_NEAR(seen.height, front_.height, 0.0013) << lit;
    EXPECT_LT((seen.center() - front_.center()).norm(), 0.0007) << lit;
    EXPECT_LT(cornerError(front_, seen), 0.0016) << lit;
  }
}

TEST_F(EdgeRefinementTest, LeavesAnEdgeAloneThatContinuesInThePlane) {
  Rectangle longer = front_;
  longer.width = 0.8;  // the surface goes on beyond both short edges
  render({{longer, 1}, {wall_, 2}});
  const RefinedRectangle refined = refine(front_);
  EXPECT_FALSE(refined.confirmed[kEdgeMinusX]);
  EXPECT_FALSE(refined.confirmed[kEdgePlusX]);
  EXPECT_TRUE(refined.confirmed[kEdgeMinusY]);
  EXPECT_TRUE(refined.confirmed[kEdgePlusY]);
  EXPECT_NEAR(refined.rectangle.width, front_.width, 1e-9);
}

TEST_F(EdgeRefinementTest, FindsAnEdgeWhereTheSideOfTheBodyBegins) {
  // The camera sees the right side of the drawer, perpendicular to the front; its disparity leaves the front's by only
  // 0.1 px a pixel, so that the masks of block matching reach some 8 px over it.
  Rectangle side;
  side.pose.linear() << -front_.pose.linear().col(2), front_.pose.linear().col(1), front_.pose.linear().col(0);
  side.pose.translation() = front_.pose * Eigen::Vector3d(front_.width / 2, 0, -0.15);
  side.width = 0.3;
  side.height = front_.height;
  ASSERT_LT(side.normal().dot(side.center()), -0.1);  // it faces the camera
  render({{front_, 1}, {side, 3}, {wall_, 2}});
  Rectangle start = front_;
  start.width += 0.015;
  start.pose.translation() += start.pose.linear() * Eigen::Vector3d(0.0075, 0, 0);
  const RefinedRectangle refined = refine(start);
  EXPECT_TRUE(refined.confirmed[kEdgePlusX]);
  EXPECT_LT(cornerError(front_, inSpace(refined.rectangle)), 0.004);  // two pixels
}

TEST_F(EdgeRefinementTest, FindsWhereADoorGoesBehindItsNeighbour) {
  for (const double angle : {0.35, 0.6, 0.9}) {
    const HingedDoor scene(angle);
    ASSERT_GT(scene.hidden, 0.0005);
    ASSERT_LT(scene.hidden, 0.012);
    render({{scene.door, 1}, {scene.neighbour, 2}, {wall_, 3}});
    const PlaneRegion door = frontRegion(scene.door, frame_.camera);
    const std::vector<PlaneRegion> regions{door, frontRegion(scene.neighbour, frame_.camera)};
    Rectangle start = scene.door;
    start.width += 0.012;  // the mask reaches over the crease
    start.pose.translation() -= 0.006 * start.pose.linear().col(0);
    const PlaneChart chart = *PlaneChart::at(start.plane(), frame_.camera, frame_.camera.project(start.center()));
    const RefinedRectangle refined = refineEdges(chart, door, {frame_, regions}, chart.fromSpace(start), {});
    EXPECT_TRUE(refined.confirmed[kEdgeMinusX]) << angle;
    const Rectangle seen = chart.toSpace(refined.rectangle);
    // Two pixels; the gap beside the door belongs to neither plane.
    EXPECT_NEAR(scene.door.width - seen.width, scene.hidden, 0.004) << angle;
    ASSERT_TRUE(refined.hidden[kEdgeMinusX]) << angle;
    EXPECT_GT(*refined.hidden[kEdgeMinusX], scene.hidden - 0.002) << angle;
    EXPECT_FALSE(refined.hidden[kEdgePlusX]);
  }
}

TEST_F(EdgeRefinementTest, AHandOverTheEdgeDoesNotBendIt) {
  Rectangle hand = exampleFront({0.05, 0.06, 1.2}, 0.07, 0.2, 0, 0, 0.3);
  render({{front_, 1}, {hand, 5}, {wall_, 2}});
  PlaneRegion region = frontRegion(front_, frame_.camera);
  region.mask.setTo(kOccluded, footprint(hand, frame_.camera));
  Rectangle start = front_;
  start.height += 0.008;
  const PlaneChart chart = *PlaneChart::at(front_.plane(), frame_.camera, frame_.camera.project(front_.center()));
  const RefinedRectangle refined = refineEdges(chart, region, {frame_, {}}, chart.fromSpace(start), {});
  EXPECT_LT(cornerError(front_, inSpace(refined.rectangle)), 0.003);
}

TEST_F(EdgeRefinementTest, AHandleBesideHalfAnEdgeDoesNotBendIt) {
  // It stands 2 cm before the front at its right edge, and the mask does not know.
  Rectangle handle = front_;
  handle.width = 0.03;
  handle.height = 0.062;
  handle.pose.translation() = front_.pose * Eigen::Vector3d(front_.width / 2 - 0.012, -0.035, 0.02);
  render({{front_, 1}, {handle, 5}, {wall_, 2}});
  const RefinedRectangle refined = refine(front_);
  EXPECT_TRUE(refined.confirmed[kEdgePlusX]);
  EXPECT_LT(cornerError(front_, inSpace(refined.rectangle)), 0.004);  // two pixels
}

TEST_F(EdgeRefinementTest, ChangesNothingWithoutImagesAndDepth) {
  frame_.camera = exampleCamera();
  const RefinedRectangle refined = refine(front_);
  for (const bool confirmed : refined.confirmed) EXPECT_FALSE(confirmed);
  EXPECT_LT(cornerError(front_, inSpace(refined.rectangle)), 1e-12);
}

TEST_F(EdgeRefinementTest, SurvivesARectangleOutsideTheImage) {
  render({{wall_, 2}});
  Rectangle outside = front_;
  outside.pose.translation() += outside.pose.linear() * Eigen::Vector3d(3, 0, 0);
  const RefinedRectangle refined = refine(outside);
  for (const bool confirmed : refined.confirmed) EXPECT_FALSE(confirmed);
}

}  // namespace
}  // namespace cabinet_articulation::core
