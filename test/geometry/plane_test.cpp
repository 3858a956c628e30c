// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/geometry/plane.h"

#include <gtest/gtest.h>

namespace cabinet_articulation::core {
namespace {

const StereoCamera kCamera{640, 480, 690, 685, 322, 236, 0.09, 3};

TEST(Plane, ImageOfAPlaneGivesTheDisparityOfItsPoints) {
  const Plane plane{Eigen::Vector3d(0.3, -0.2, -1).normalized(), 1.4};
  const DisparityPlane image = *toDisparityPlane(plane, kCamera);
  for (const auto& pixel : {Eigen::Vector2d(0, 0), Eigen::Vector2d(639, 20), Eigen::Vector2d(300, 479)}) {
    const Eigen::Vector3d p = *plane.intersect(kCamera.ray(pixel.x(), pixel.y()));
    EXPECT_NEAR(plane.distance(p), 0, 1e-12);
    EXPECT_NEAR(image.at(pixel.x(), pixel.y()), kCamera.disparity(p.z()), 1e-9);
  }
}

TEST(Plane, ComesBackFromItsImage) {
  const Plane plane{Eigen::Vector3d(-0.5, 0.4, -0.8).normalized(), 0.9};
  const Plane back = *toPlane(*toDisparityPlane(plane, kCamera), kCamera);
  EXPECT_TRUE(back.normal.isApprox(plane.normal, 1e-12));
  EXPECT_NEAR(back.offset, plane.offset, 1e-12);
}

TEST(Plane, NormalPointsToTheCamera) {
  const Plane plane = *toPlane({0, 0, 40}, kCamera);
  EXPECT_LT(plane.normal.z(), -0.999);
  EXPECT_NEAR(plane.offset, kCamera.depth(40), 1e-12);
}

TEST(Plane, WithoutAnImageGivesNothing) {
  EXPECT_FALSE(toDisparityPlane({Eigen::Vector3d::UnitX(), 0}, kCamera));
  EXPECT_FALSE(toPlane({0, 0, 0}, kCamera));
  EXPECT_FALSE((Plane{Eigen::Vector3d(0, 0, -1), 1}.intersect(Eigen::Vector3d::UnitX())));
}

}  // namespace
}  // namespace cabinet_articulation::core
