// SPDX-License-Identifier: BSD-3-Clause
#include "kinds/joint_kind.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cabinet_articulation::core {
namespace {

JointShape doorShape(double radius, const Eigen::Vector3d& turn = Eigen::Vector3d::Zero()) {
  JointShape shape;
  shape.type = JointType::kRotational;
  shape.frame = rotationFromVector(turn);
  shape.radius = radius;
  return shape;
}

JointShape drawerShape(const Eigen::Vector3d& direction) {
  JointShape shape;
  shape.frame = arcFrame(direction, Eigen::Vector3d::Zero());
  return shape;
}

TEST(JointShape, OfALearnedDoorIsTheOneOfItsArcWhereverItStands) {
  LearnedModel door;
  door.type = JointType::kRotational;
  door.origin.translation() << 0.4, 0, 0;
  door.axis = Eigen::Vector3d::UnitZ();
  door.axis_point = Eigen::Vector3d::Zero();
  door.radius = 0.4;
  const JointShape here = shapeOf(door, door.origin.linear());
  EXPECT_TRUE(here.frame.col(0).isApprox(Eigen::Vector3d::UnitY()));
  EXPECT_TRUE(here.frame.col(1).isApprox(-Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(here.frame.col(2).isApprox(Eigen::Vector3d::UnitZ()));

  const Eigen::Isometry3d place = Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized());
  door.origin = place * door.origin;
  door.axis = place.linear() * door.axis;
  door.axis_point = place * door.axis_point;
  EXPECT_LT(difference(shapeOf(door, door.origin.linear()), here).norm(), 1e-9);
}

TEST(JointShape, TurningALineAboutItselfChangesNothing) {
  JointShape turned = drawerShape(Eigen::Vector3d::UnitZ());
  turned.frame = turned.frame * rotationFromVector(1.2 * Eigen::Vector3d::UnitX());
  EXPECT_LT(difference(turned, drawerShape(Eigen::Vector3d::UnitZ())).norm(), 1e-9);
}

TEST(JointShape, OfTheMeanIsInTheMiddle) {
  const JointShape mean = meanShape({doorShape(0.3, {0, 0, 0.1}), doorShape(0.48, {0, 0, 0.3})});
  EXPECT_LT(difference(mean, doorShape(std::sqrt(0.3 * 0.48), {0, 0, 0.2})).norm(), 1e-9);
}

/// The chain rule: the density of two shapes is that of the first, times that of the second if the first is known. The first is
/// 1, for its mean may be anywhere.
TEST(JointKind, EvidenceOfTwoIsTheDensityOfTheSecond) {
  const KindsConfig config;
  for (const auto& [first, second] : {std::pair(doorShape(0.4), doorShape(0.42, {0.05, -0.1, 0.02})),
                                      std::pair(drawerShape({0, 0, 1}), drawerShape({0.1, 0, 1}))}) {
    const JointKind one({first}, config);
    EXPECT_NEAR(one.logEvidence(), 0, 1e-9);
    const ShapePrior next = one.next();
    const double density = next.log_constant - next.cost(difference(second, next.mean));
    EXPECT_NEAR(JointKind({first, second}, config).logEvidence(), density, 1e-3);  // directions are a sphere, not a plane
  }
}

TEST(JointKind, DensityOfTheNextOneIsOneInAll) {
  const ShapePrior next = JointKind({drawerShape({0, 0, 1}), drawerShape({0.05, 0, 1})}, {}).next();
  constexpr double kStep = 0.01, kRange = 3;
  double sum = 0;
  for (double a = -kRange; a < kRange; a += kStep)
    for (double b = -kRange; b < kRange; b += kStep)
      sum += kStep * kStep * std::exp(next.log_constant - next.cost(Eigen::Vector2d(a, b)));
  EXPECT_NEAR(sum, 1, 0.01);
}

TEST(JointKind, JointsOutweighTheSpreadBeforehand) {
  std::vector<JointShape> alike(40, doorShape(0.4)), unlike;
  for (int i = 0; i < 40; ++i) unlike.push_back(doorShape(0.4 * std::exp(i % 2 ? 0.2 : -0.2)));
  const auto sigma = [](const std::vector<JointShape>& shapes) {
    return 1 / std::sqrt(JointKind(shapes, KindsConfig()).next().precision(3, 3));
  };
  EXPECT_LT(sigma(alike), KindsConfig().radius_spread / 2);
  EXPECT_NEAR(sigma(unlike), 0.2, 0.02);
}

}  // namespace
}  // namespace cabinet_articulation::core
