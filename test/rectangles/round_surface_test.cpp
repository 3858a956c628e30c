// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/edges/round_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>

#include "front_scene.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kDistance = 1.3;                                                          ///< [m]
constexpr std::pair<double, double> kCameras[] = {{450, 0.07}, {690, 0.09}, {900, 0.12}};  ///< focal length [px], baseline [m]

class RoundSurfaceTest : public testing::Test {
 protected:
  RoundSurfaceTest() { frame_.camera = exampleCamera(); }

  void use(double focal_length, double baseline) {
    frame_.camera.fx = frame_.camera.fy = focal_length;
    frame_.camera.baseline = baseline;
  }

  /// The depth of each pixel's ray, from the place (x, y) at which it meets the front's plane.
  void fill(const std::function<double(double, double)>& depth) {
    frame_.disparity.create(frame_.camera.height, frame_.camera.width);
    for (int v = 0; v < frame_.camera.height; ++v)
      for (int u = 0; u < frame_.camera.width; ++u) {
        const Eigen::Vector3d p = frame_.camera.ray(u, v) * kDistance;
        frame_.disparity(v, u) = static_cast<float>(frame_.camera.disparity(depth(p.x(), p.y())));
      }
  }

  bool bends(const Rectangle& front, Edge edge) const {
    const PlaneChart chart = *PlaneChart::at(front.plane(), frame_.camera, frame_.camera.project(front.center()));
    return bendsAway(frame_, *toDisparityPlane(front.plane(), frame_.camera), *imageEdge(chart, chart.fromSpace(front), edge));
  }

  DepthFrame frame_;
};

TEST_F(RoundSurfaceTest, SeesTheSidesOfABinBendAway) {
  constexpr double kRadius = 0.16, kHalfWidth = 0.075, kHalfHeight = 0.15;
  const double sagitta = kHalfWidth * kHalfWidth / (2 * kRadius);
  for (const auto& [focal_length, baseline] : kCameras) {
    use(focal_length, baseline);
    // The plane runs through the middle of what it holds, as a fitted one does.
    fill([&](double x, double y) {
      const double bend = std::abs(x) < kRadius ? kRadius - std::sqrt(kRadius * kRadius - x * x) : 1;
      return std::abs(y) < kHalfHeight ? kDistance + bend - sagitta / 3 : 2.0;
    });
    const Rectangle patch = exampleFront({0, 0, kDistance}, 2 * kHalfWidth, 2 * kHalfHeight, 0, 0, 0);
    EXPECT_TRUE(bends(patch, kEdgeMinusX)) << focal_length;
    EXPECT_TRUE(bends(patch, kEdgePlusX)) << focal_length;
    EXPECT_FALSE(bends(patch, kEdgeMinusY)) << focal_length;
    EXPECT_FALSE(bends(patch, kEdgePlusY)) << focal_length;
  }
}

TEST_F(RoundSurfaceTest, AFlatFrontEndsInAStepAlsoWhereBlockMatchingBlursIt) {
  for (const auto& [focal_length, baseline] : kCameras)
    for (const double behind : {0.03, 0.05, 0.3})
      for (const int window : {1, 15}) {
        use(focal_length, baseline);
        fill([&](double x, double y) { return std::abs(x) < 0.2 && std::abs(y) < 0.15 ? kDistance : kDistance + behind; });
        cv::blur(frame_.disparity, frame_.disparity, {window, window});
        for (const Edge edge : kEdges)
          EXPECT_FALSE(bends(exampleFront({0, 0, kDistance}, 0.4, 0.3, 0, 0, 0), edge)) << focal_length << " " << behind;
      }
}

TEST_F(RoundSurfaceTest, ASurfaceThatGoesOnDoesNotBend) {
  fill([](double, double) { return kDistance; });
  for (const Edge edge : kEdges) EXPECT_FALSE(bends(exampleFront({0, 0, kDistance}, 0.4, 0.3, 0, 0, 0), edge));
}

TEST_F(RoundSurfaceTest, TheHingeOfADoorThatHasJustOpenedIsNoEdge) {
  for (const double slope : {0.06, -0.06, 0.3}) {  // [rad] of the neighbour on the left, seen from the door
    fill([&](double x, double y) {
      if (x > 0.2 || std::abs(y) > 0.15) return kDistance + 0.1;
      return x < -0.2 ? kDistance + slope * (-0.2 - x) : kDistance;
    });
    const Rectangle door = exampleFront({0, 0, kDistance}, 0.4, 0.3, 0, 0, 0);
    EXPECT_EQ(bends(door, kEdgeMinusX), std::abs(slope) < 0.1) << slope;
    for (const Edge edge : {kEdgePlusX, kEdgeMinusY, kEdgePlusY}) EXPECT_FALSE(bends(door, edge)) << slope;
  }
}

TEST_F(RoundSurfaceTest, NothingIsKnownWithoutDepth) {
  const Rectangle front = exampleFront({0, 0, kDistance}, 0.4, 0.3, 0, 0, 0);
  for (const Edge edge : kEdges) EXPECT_FALSE(bends(front, edge));
  frame_.disparity = cv::Mat1f(frame_.camera.height, frame_.camera.width, std::numeric_limits<float>::quiet_NaN());
  for (const Edge edge : kEdges) EXPECT_FALSE(bends(front, edge));
  fill([](double, double) { return kDistance; });
  EXPECT_FALSE(bends(exampleFront({3, 0, kDistance}, 0.4, 0.3, 0, 0, 0), kEdgePlusX));  // outside the image
}

}  // namespace
}  // namespace cabinet_articulation::core
