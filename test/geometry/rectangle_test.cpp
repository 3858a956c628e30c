// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/geometry/rectangle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cabinet_articulation::core {
namespace {

Rectangle example() {
  Rectangle rectangle;
  rectangle.pose = Eigen::Translation3d(0.1, -0.2, 1.5) * Eigen::AngleAxisd(2.8, Eigen::Vector3d(1, 0.2, 0.1).normalized());
  rectangle.width = 0.4;
  rectangle.height = 0.6;
  return rectangle;
}

TEST(Rectangle, EightDescriptionsAreTheSamePointSet) {
  const Rectangle original = example();
  for (int k = 0; k < kDescriptions; ++k) {
    const Rectangle other = describe(original, k);
    EXPECT_NEAR(intersectionOverUnion(original, other), 1, 1e-9) << k;
    EXPECT_TRUE((other.pose.linear() * other.pose.linear().transpose()).isIdentity(1e-12)) << k;
    EXPECT_NEAR(other.pose.linear().determinant(), 1, 1e-12) << k;
    EXPECT_NEAR(other.normal().dot(original.normal()), k < 4 ? 1 : -1, 1e-12) << k;
    for (const Eigen::Vector3d& corner : other.corners()) {
      double nearest = 1;
      for (const Eigen::Vector3d& candidate : original.corners()) nearest = std::min(nearest, (corner - candidate).norm());
      EXPECT_LT(nearest, 1e-12) << k;
    }
  }
}

TEST(Rectangle, AlignmentUndoesEveryDescription) {
  const Rectangle original = example();
  for (int k = 0; k < kDescriptions; ++k) {
    const Rectangle aligned = alignDescription(describe(original, k), original, true);
    EXPECT_LT(angleBetween(aligned.pose, original.pose), 1e-9) << k;
    EXPECT_DOUBLE_EQ(aligned.width, original.width) << k;
  }
}

TEST(Rectangle, AngleIsThatOfTheShortWayRound) {
  Eigen::Isometry3d turned = Eigen::Isometry3d::Identity();
  turned.rotate(Eigen::AngleAxisd(3.5, Eigen::Vector3d::UnitY()));
  EXPECT_NEAR(angleBetween(turned, Eigen::Isometry3d::Identity()), 2 * M_PI - 3.5, 1e-12);
}

TEST(Rectangle, IntersectionOverUnionOfAShiftedCopy) {
  const Rectangle original = example();
  Rectangle shifted = original;
  shifted.pose.translate(Eigen::Vector3d(0.1, 0, 0));
  EXPECT_NEAR(intersectionOverUnion(original, shifted), 0.3 / 0.5, 1e-12);
  shifted.pose.translate(Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(intersectionOverUnion(original, shifted), 0);
}

}  // namespace
}  // namespace cabinet_articulation::core
