// SPDX-License-Identifier: BSD-3-Clause
#include "kinds/upright.h"

#include <gtest/gtest.h>

#include "articulation/paths/arc.h"
#include "cabinet_articulation/geometry/rectangle.h"

namespace cabinet_articulation::core {
namespace {

Eigen::Matrix3d axes(const Eigen::Vector3d& y, const Eigen::Vector3d& z) {
  Eigen::Matrix3d front;
  front << y.cross(z), y, z;
  return front;
}

TEST(Upright, FrontsOfARoomHaveUpAlongZWhereverTheyFace) {
  for (const double yaw : {0.0, 1.0, 2.0, 3.0, 5.0}) {
    Rectangle front;
    front.pose.linear() = axes(Eigen::Vector3d::UnitZ(), Eigen::Vector3d(std::cos(yaw), std::sin(yaw), 0));
    for (int k = 0; k < 4; ++k) {
      const Rectangle other = describe(front, k);
      const Rectangle upright = describe(other, uprightDescription(other.pose.linear()));
      EXPECT_TRUE(upright.pose.linear().isApprox(front.pose.linear(), 1e-9)) << yaw << " " << k;
    }
  }
}

TEST(Upright, FrontsBeforeACameraHaveUpAgainstY) {
  Rectangle front;
  front.pose.linear() = axes(-Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitZ());
  EXPECT_EQ(uprightDescription(front.pose.linear()), 0);
  EXPECT_EQ(uprightDescription(describe(front, 1).pose.linear()), 3);
}

TEST(Upright, ShapesTurnWithTheDescription) {
  JointShape shape;
  shape.frame = rotationFromVector(Eigen::Vector3d(0.1, 0.2, 0.3));
  shape.width = 0.4;
  shape.height = 0.6;
  const Eigen::Matrix3d front = rotationFromVector(Eigen::Vector3d(1, 0.5, -0.7));
  for (int k = 0; k < 4; ++k) {
    Rectangle rectangle;
    rectangle.pose.linear() = front;
    const JointShape other = described(shape, k);
    EXPECT_TRUE((describe(rectangle, k).pose.linear() * other.frame).isApprox(front * shape.frame, 1e-9));
    EXPECT_EQ(other.width, k % 2 == 0 ? 0.4 : 0.6);
    EXPECT_TRUE(described(other, kDescriptionsOfASide - k).frame.isApprox(shape.frame, 1e-9));
  }
}

}  // namespace
}  // namespace cabinet_articulation::core
