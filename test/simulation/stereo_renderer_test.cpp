// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/stereo_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "cabinet_articulation/geometry/plane.h"

namespace cabinet_articulation::core {
namespace {

using Eigen::Vector3d;

const StereoCamera kCamera{640, 480, 690, 690, 322, 236, 0.09, 0};

Surface board(const Vector3d& centre, double turn, double width = 4, double height = 4) {
  Surface surface;
  surface.rectangle.pose =
      Eigen::Translation3d(centre) * Eigen::AngleAxisd(turn, Vector3d::UnitY()) * Eigen::AngleAxisd(EIGEN_PI, Vector3d::UnitX());
  surface.rectangle.width = width;
  surface.rectangle.height = height;
  surface.reflectance = 0.8;
  return surface;
}

double mean(const cv::Mat& image, const cv::Rect& area) { return cv::mean(image(area))[0]; }

TEST(StereoRenderer, DepthIsThatOfThePlane) {
  StereoRenderer renderer({}, kCamera);
  const Surface surface = board({0, 0, 1.4}, 0.6);
  const cv::Mat1f depth = renderer.render({surface}).depth;
  const Plane plane = surface.rectangle.plane();
  for (int v = 0; v < 480; v += 7)
    for (int u = 0; u < 640; u += 5) EXPECT_NEAR(depth(v, u), plane.intersect(kCamera.ray(u, v))->z(), 1e-5);
}

TEST(StereoRenderer, DepthEndsAtTheRectanglesEdges) {
  StereoRenderer renderer({}, kCamera);
  const Surface surface = board({0.1, 0, 1}, 0, 0.4, 0.2);
  const cv::Mat1f depth = renderer.render({surface}).depth;
  // 690 px * 0.4 m / 1 m = 276 px wide, 138 px high; a pixel belongs to what its centre sees.
  EXPECT_EQ(cv::countNonZero(depth > 0), 276 * 138);
  const double left = kCamera.project({-0.1, 0, 1}).x();
  EXPECT_EQ(depth(236, static_cast<int>(std::ceil(left)) - 1), 0);
  EXPECT_GT(depth(236, static_cast<int>(std::ceil(left))), 0);
}

TEST(StereoRenderer, NearerSurfaceHidesFartherOneInWhateverOrder) {
  StereoRenderer renderer({}, kCamera);
  const Surface near = board({0, 0, 1}, 0, 0.3, 0.3), far = board({0, 0, 2}, 0);
  EXPECT_NEAR(renderer.render({near, far}).depth(236, 322), 1, 1e-5);
  EXPECT_NEAR(renderer.render({far, near}).depth(236, 322), 1, 1e-5);
  EXPECT_NEAR(renderer.render({far, near}).depth(20, 20), 2, 1e-5);
}

TEST(StereoRenderer, BackSidesAndThingsBehindTheCameraAreNotDrawn) {
  StereoRenderer renderer({}, kCamera);
  EXPECT_EQ(cv::countNonZero(renderer.render({board({0, 0, 1}, EIGEN_PI)}).depth), 0);
  EXPECT_EQ(cv::countNonZero(renderer.render({board({0, 0, -1}, 0)}).depth), 0);
}

TEST(StereoRenderer, FloorUnderTheCameraIsClippedNotTurnedInsideOut) {
  StereoRenderer renderer({}, kCamera);
  Surface floor;
  floor.rectangle.pose = Eigen::Translation3d(0, 1, 0) * Eigen::AngleAxisd(EIGEN_PI / 2, Vector3d::UnitX());
  floor.rectangle.width = floor.rectangle.height = 20;
  const cv::Mat1f depth = renderer.render({floor}).depth;
  EXPECT_EQ(depth(230, 320), 0);
  EXPECT_NEAR(depth(479, 320), 690.0 / (479 - 236), 1e-4);
}

TEST(StereoRenderer, RightImageIsTheLeftShiftedByTheDisparity) {
  StereoRenderer renderer({}, kCamera);
  // Disparity of 45 px exactly: a frontal board looks the same in both images.
  const RenderedPair& pair = renderer.render({board({0, 0, kCamera.depth(45)}, 0)});
  const cv::Mat left = pair.left.colRange(100, 600), right = pair.right.colRange(55, 555);
  EXPECT_LT(cv::norm(left, right, cv::NORM_INF), 1e-4);
  EXPECT_GT(cv::norm(left, cv::NORM_INF), 0.3);
}

TEST(StereoRenderer, LightFallsOffWithDistanceAndAngle) {
  SimulationConfig config;
  config.ambient = 0;
  StereoRenderer renderer(config, kCamera);
  const cv::Rect middle(282, 196, 80, 80);  // some 500 squares of the pattern: the mean is known to 5 %
  const double at_1m = mean(renderer.render({board({0, 0, 1}, 0)}).left, middle);
  const double at_2m = mean(renderer.render({board({0, 0, 2}, 0)}).left, middle);
  const double turned = mean(renderer.render({board({0, 0, 1}, 1)}).left, middle);
  EXPECT_NEAR(at_2m / at_1m, 0.25, 0.02);
  EXPECT_NEAR(turned / at_1m, std::cos(1), 0.05);
  EXPECT_NEAR(at_1m, 0.8 * 0.52, 0.04) << "half of the squares are white";
}

/// Whatever the size of the squares: a shadow is looked up for every place in the pattern.
TEST(StereoRenderer, TheShadowsReachToTheRimOfThePattern) {
  for (double cell = 1.5; cell <= 40; cell += 0.1) {
    SimulationConfig config;
    config.pattern_cell = cell;
    const TextureProjector projector(config);
    const double scale = projector.shadowView().focal / projector.patternView().focal;
    const auto nearest = [scale](int last) { return static_cast<int>(last * scale + (scale - 1) / 2 + 0.5); };
    EXPECT_LT(nearest(projector.patternView().width - 1), projector.shadowView().width) << cell;
    EXPECT_LT(nearest(projector.patternView().height - 1), projector.shadowView().height) << cell;
  }
}

TEST(StereoRenderer, ObjectsCastShadowsOnlyWhereTheProjectorIsBlocked) {
  SimulationConfig config;
  config.ambient = 0;
  const std::vector<Surface> surfaces = {board({0, 0, 1.5}, 0), board({0, 0, 0.8}, 0, 0.2, 0.2)};
  StereoRenderer renderer(config, kCamera);
  // The projector sits 5 cm to the right: the shadow appears left of the obstacle, between its image (x = -0.1 / 0.8)
  // and the projection of its edge from (0.05, -0.035): 0.05 - 0.15 * 1.5 / 0.8 = -0.231 m at 1.5 m.
  const int from = static_cast<int>(322 - 690 * 0.231 / 1.5) + 3, to = static_cast<int>(322 - 690 * 0.1 / 0.8) - 3;
  ASSERT_GT(to - from, 10);
  const cv::Rect shadow(from, 220, to - from, 30);
  const RenderedPair& pair = renderer.render(surfaces);
  EXPECT_EQ(mean(pair.left, shadow), 0);
  EXPECT_GT(mean(pair.left, shadow - cv::Point(to - from + 6, 0)), 0.05) << "beside the shadow";
  EXPECT_GT(mean(pair.left, cv::Rect(260, 180, 120, 110)), 0.1) << "the obstacle does not shade itself";
  config.shadows = false;
  EXPECT_GT(mean(StereoRenderer(config, kCamera).render(surfaces).left, shadow), 0.05);
}

TEST(StereoRenderer, SlantedSurfacesDoNotShadeThemselves) {
  SimulationConfig config;
  StereoRenderer shaded(config, kCamera);
  config.shadows = false;
  StereoRenderer unshaded(config, kCamera);
  const std::vector<Surface> surfaces = {board({0, 0, 1.4}, 1.2)};
  EXPECT_EQ(cv::norm(shaded.render(surfaces).left, unshaded.render(surfaces).left, cv::NORM_INF), 0);
}

TEST(StereoRenderer, EdgesAreAntialiased) {
  SimulationConfig config;
  config.pattern_cell = 40;
  config.ambient = 10;  // ambient light only, in effect
  StereoRenderer renderer(config, kCamera);
  // The left edge cuts a pixel column at two thirds: x = (200 - 1/6 - 322) / 690.
  Surface surface = board({0, 0, 1}, 0);
  const double left = (200 - 1.0 / 6 - kCamera.cx) / kCamera.fx;
  surface.rectangle.pose.translation().x() = left + surface.rectangle.width / 2;
  const cv::Mat1f image = renderer.render({surface}).left;
  EXPECT_EQ(image(240, 199), 0);
  EXPECT_NEAR(image(240, 200) / image(240, 204), 2.0 / 3, 0.1);
}

}  // namespace
}  // namespace cabinet_articulation::core
