// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/geometry/stereo_camera.h"

#include <gtest/gtest.h>

#include <limits>

namespace cabinet_articulation::core {
namespace {

const std::array<double, 12> kLeft{600, 0, 310, 0, 0, 610, 250, 0, 0, 0, 1, 0};
const std::array<double, 12> kRight{600, 0, 300, -54, 0, 610, 250, 0, 0, 0, 1, 0};

std::string messageOf(std::array<double, 12> left, std::array<double, 12> right) {
  try {
    StereoCamera::fromProjections(640, 480, left, right);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(StereoCamera, TakesEverythingFromTheProjectionMatrices) {
  const StereoCamera camera = StereoCamera::fromProjections(640, 480, kLeft, kRight);
  EXPECT_DOUBLE_EQ(camera.baseline, 0.09);
  EXPECT_DOUBLE_EQ(camera.cx_difference, 10);
  EXPECT_DOUBLE_EQ(camera.fy, 610);
}

TEST(StereoCamera, ProjectsBackWhatItReprojects) {
  const StereoCamera camera = StereoCamera::fromProjections(640, 480, kLeft, kRight);
  const Eigen::Vector3d p = camera.point(12.5, 470.25, 36.0);
  EXPECT_NEAR(p.z(), 54.0 / 36.0, 1e-12);
  EXPECT_TRUE(camera.project(p).isApprox(Eigen::Vector2d(12.5, 470.25), 1e-12));
}

TEST(StereoCamera, SaysWhichElementIsWrong) {
  auto right = kRight;
  right[3] = 0;
  EXPECT_NE(messageOf(kLeft, right).find("right P[3] is 0, expected -fx * baseline"), std::string::npos);
  auto left = kLeft;
  left[0] = 0;
  EXPECT_NE(messageOf(left, kRight).find("left P[0] is 0, expected a positive focal length"), std::string::npos);
  left[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(messageOf(left, kRight).find("left P[0] is nan"), std::string::npos);
}

TEST(StereoCamera, DescribesADepthCamera) {
  const StereoCamera camera = StereoCamera::fromDepthCamera(640, 480, {525, 0, 319.5, 0, 526, 239.5, 0, 0, 1}, 0.075);
  EXPECT_DOUBLE_EQ(camera.focalBaseline(), 525 * 0.075);
  EXPECT_THROW(StereoCamera::fromDepthCamera(640, 480, {0, 0, 319.5, 0, 526, 239.5, 0, 0, 1}, 0.075), std::invalid_argument);
}

}  // namespace
}  // namespace cabinet_articulation::core
