// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/edges/side_face.h"

#include <gtest/gtest.h>

#include "front_scene.h"

namespace cabinet_articulation::core {
namespace {

class SideFaceTest : public testing::Test {
 protected:
  double slope(const Rectangle& front, Edge edge) const {
    const PlaneChart chart = *PlaneChart::at(front.plane(), camera_, camera_.project(front.center()));
    return sideFace(chart, camera_, *toDisparityPlane(front.plane(), camera_), chart.fromSpace(front), edge).slope;
  }

  const StereoCamera camera_ = exampleCamera();
};

TEST_F(SideFaceTest, FallsAsGeometrySays) {
  // Seen 30 degrees from the right at distance z, a pixel outward on the face is z / f / sin(30) backward along it.
  const Rectangle front = exampleFront({0, 0, 1.3}, 0.02, 0.3, -M_PI / 6, 0, 0);
  const double expected = -camera_.baseline / 1.3 / (std::sin(M_PI / 6) * std::cos(M_PI / 6));
  const double left = slope(front, kEdgeMinusX), right = slope(front, kEdgePlusX);
  EXPECT_NEAR(std::min(left, right), expected, 0.05 * std::abs(expected));  // the front is narrow, but not a line
  EXPECT_EQ(std::max(left, right), 0);                                      // the other side is turned away
}

TEST_F(SideFaceTest, NobodySeesTheSidesOfAFrontSeenHeadOn) {
  const Rectangle front = exampleFront({0, 0, 1.3}, 0.4, 0.3, 0, 0, 0);
  for (const Edge edge : kEdges) EXPECT_EQ(slope(front, edge), 0);
}

TEST_F(SideFaceTest, IsTooNarrowFarAway) {
  EXPECT_LT(slope(exampleFront({0, 0, 1.3}, 0.02, 0.3, -M_PI / 6, 0, 0), kEdgePlusX) +
                slope(exampleFront({0, 0, 1.3}, 0.02, 0.3, -M_PI / 6, 0, 0), kEdgeMinusX),
            0);
  const Rectangle far = exampleFront({0, 0, 4}, 0.02, 0.3, -M_PI / 6, 0, 0);
  for (const Edge edge : kEdges) EXPECT_EQ(slope(far, edge), 0);
}

TEST_F(SideFaceTest, SurvivesARectangleBehindTheCamera) {
  const Rectangle front = exampleFront({0, 0, 1.3}, 0.4, 0.3, 0.5, 0, 0);
  const PlaneChart chart = *PlaneChart::at(front.plane(), camera_, camera_.project(front.center()));
  PlaneRectangle behind = chart.fromSpace(front);
  behind.width = 10;
  for (const Edge edge : kEdges)
    EXPECT_EQ(sideFace(chart, camera_, *toDisparityPlane(front.plane(), camera_), behind, edge).slope, 0);
}

}  // namespace
}  // namespace cabinet_articulation::core
