// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/chart/plane_chart.h"

#include <gtest/gtest.h>

#include "front_scene.h"
#include "rectangles/chart/image_edge.h"

namespace cabinet_articulation::core {
namespace {

class PlaneChartTest : public testing::Test {
 protected:
  const StereoCamera camera_ = exampleCamera();
  const Rectangle front_ = exampleFront({0.1, -0.05, 1.3}, 0.4, 0.3, 0.4, -0.2, 0.3);
  const PlaneChart chart_ = *PlaneChart::at(front_.plane(), camera_, {300, 200});
};

TEST_F(PlaneChartTest, KeepsARectangleThroughThePlaneAndBack) {
  const Rectangle back = chart_.toSpace(chart_.fromSpace(front_));
  EXPECT_LT(cornerError(front_, back), 1e-12);
  EXPECT_EQ(back.width, front_.width);
  EXPECT_EQ(back.height, front_.height);
}

TEST_F(PlaneChartTest, ProjectsCornersLikeTheCamera) {
  const ImageQuad quad = *chart_.project(chart_.fromSpace(front_));
  for (size_t i = 0; i < 4; ++i) EXPECT_LT((quad[i] - camera_.project(front_.corners()[i])).norm(), 1e-9);
}

TEST_F(PlaneChartTest, FromPixelInvertsToPixel) {
  const Eigen::Vector2d pixel(123.4, 321.0);
  EXPECT_LT((chart_.toPixel(*chart_.fromPixel(pixel)) - pixel).norm(), 1e-9);
}

TEST_F(PlaneChartTest, HasNoPointWhereThePlaneIsNotSeen) {
  EXPECT_FALSE(PlaneChart::at({Eigen::Vector3d(0, -1, 0), 1.0}, camera_, {320, 100}));  // the floor, above the horizon
  const PlaneChart floor = *PlaneChart::at({Eigen::Vector3d(0, -1, 0), 1.0}, camera_, {320, 400});
  EXPECT_FALSE(floor.fromPixel({320, 100}));
  EXPECT_FALSE(floor.project({{0, 0}, 0, 0.5, 1000}));  // reaches behind the camera
}

TEST_F(PlaneChartTest, AnEdgeMovesOutwardByWhatMetresPerPixelSays) {
  PlaneRectangle rectangle = chart_.fromSpace(front_);
  for (const Edge edge : kEdges) {
    const ImageEdge before = *imageEdge(chart_, rectangle, edge);
    PlaneRectangle grown = rectangle;
    grown.moveEdge(edge, before.metres_per_pixel);
    const ImageEdge after = *imageEdge(chart_, grown, edge);
    const Eigen::Vector2d middle = (after.a + after.b) / 2;
    EXPECT_NEAR(before.outward.dot(middle - before.a), 1.0, 0.02) << edge;
  }
}

}  // namespace
}  // namespace cabinet_articulation::core
