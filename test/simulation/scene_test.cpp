// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/simulation/scene.h"

#include <gtest/gtest.h>

namespace cabinet_articulation::core {
namespace {

using Eigen::Vector3d;

TEST(Scene, BoxHasSixOutwardSidesOfItsSize) {
  Box box;
  box.pose = Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(0.4, Vector3d(1, 2, -1).normalized());
  box.size = {0.2, 0.3, 0.5};
  std::vector<Surface> surfaces;
  addBox(box, 0.5, 4, &surfaces);
  ASSERT_EQ(surfaces.size(), 6U);
  double area = 0;
  for (const Surface& surface : surfaces) {
    const Rectangle& side = surface.rectangle;
    EXPECT_GT(side.normal().dot(side.center() - box.pose.translation()), 0.09);
    EXPECT_NEAR(side.pose.linear().determinant(), 1, 1e-12);
    EXPECT_EQ(surface.part, 4);
    for (const Vector3d& corner : side.corners())
      EXPECT_TRUE(((box.pose.inverse() * corner).cwiseAbs() - box.size / 2).isZero(1e-12));
    area += side.width * side.height;
  }
  EXPECT_NEAR(area, 2 * (0.2 * 0.3 + 0.3 * 0.5 + 0.5 * 0.2), 1e-12);
}

TEST(Scene, FrontFacesTheRoomWithItsHeightUp) {
  const Rectangle front = frontOf(boxBetween({0.1, 0, 0.2}, {0.5, 0.02, 0.8}));
  EXPECT_TRUE(front.normal().isApprox(-Vector3d::UnitY(), 1e-12));
  EXPECT_TRUE(front.pose.linear().col(1).isApprox(Vector3d::UnitZ(), 1e-12));
  EXPECT_NEAR(front.pose.linear().determinant(), 1, 1e-12);
  EXPECT_TRUE(front.center().isApprox(Vector3d(0.3, 0, 0.5), 1e-12));
  EXPECT_NEAR(front.width, 0.4, 1e-12);
  EXPECT_NEAR(front.height, 0.6, 1e-12);
}

TEST(Scene, JointsMoveWhatTheyCarryAndNothingElse) {
  Scene scene;
  Joint drawer;
  drawer.type = JointType::kPrismatic;
  drawer.axis = -Vector3d::UnitY();
  Joint door;
  door.type = JointType::kRotational;
  door.axis = -Vector3d::UnitZ();
  door.axis_point = {1, 0, 0};
  scene.joints = {drawer, door};
  for (const int part : {kFixedPart, 0, 1}) {
    Surface surface;
    surface.part = part;
    surface.rectangle.pose.translation() = Vector3d(2, 0, 0.5);
    scene.surfaces.push_back(surface);
  }
  const std::vector<Surface> moved = scene.surfacesAt({0.25, EIGEN_PI / 2});
  EXPECT_TRUE(moved[0].rectangle.center().isApprox(Vector3d(2, 0, 0.5), 1e-12));
  EXPECT_TRUE(moved[1].rectangle.center().isApprox(Vector3d(2, -0.25, 0.5), 1e-12));
  // A quarter turn, clockwise from above, takes what lies at +x of the axis towards the room (-y).
  EXPECT_TRUE(moved[2].rectangle.center().isApprox(Vector3d(1, -1, 0.5), 1e-12));
}

TEST(Scene, CameraLooksAtItsTargetWithTheHorizonLevel) {
  const Vector3d eye(-0.5, -1.2, 1), target(0.1, 0, 0.4);
  const Eigen::Isometry3d pose = lookAt(eye, target);
  const Vector3d seen = pose.inverse() * target;
  EXPECT_TRUE(seen.isApprox(Vector3d(0, 0, (target - eye).norm()), 1e-12));
  EXPECT_NEAR(pose.linear()(2, 0), 0, 1e-12);
  EXPECT_LT(pose.linear()(2, 1), 0) << "y points down";
  EXPECT_NEAR(pose.linear().determinant(), 1, 1e-12);
}

}  // namespace
}  // namespace cabinet_articulation::core
