// SPDX-License-Identifier: BSD-3-Clause
#include "scores/interval_coverage.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cabinet_articulation::core::evaluation {
namespace {

AxisEstimate door() {
  AxisEstimate estimate;
  estimate.type = JointType::kRotational;
  estimate.axis = Eigen::Vector3d::UnitY();
  estimate.axis_point = Eigen::Vector3d(-0.2, 0, 1.5);
  estimate.center = Eigen::Vector3d(0, 0, 1.5);
  estimate.radius = 0.2;
  return estimate;
}

TEST(IntervalCoverage, OneIsTheLimitOfTheRadius) {
  AxisEstimate estimate = door();
  estimate.radius += 1.96 * 0.003;
  estimate.covariance.diagonal() << 9e-6, 1, 1, 1, 1, 1;  // only x is radial
  EXPECT_NEAR(*checkIntervals(estimate, door()).radius, 1, 1e-3);
}

TEST(IntervalCoverage, OneIsTheLimitOfTheAxis) {
  AxisEstimate estimate = door();
  // 95 % of two independent normal numbers of variance s^2 lie within s * sqrt(5.99) of their means.
  const double tilt = 0.01 * std::sqrt(5.991);
  estimate.axis = Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitX()) * estimate.axis;
  estimate.covariance.diagonal() << 1, 1, 1, 1e-4, 1, 1e-4;  // a turn about the axis itself does not count
  EXPECT_NEAR(checkIntervals(estimate, door()).axis, 1, 1e-3);
  estimate.axis = -estimate.axis;
  EXPECT_NEAR(checkIntervals(estimate, door()).axis, 1, 1e-3);
}

TEST(IntervalCoverage, NoisyFrontsAreNearTheirTruthAndRepeatable) {
  for (const JointType type : {JointType::kPrismatic, JointType::kRotational}) {
    const NoisyFront front = simulateNoisyFront(type, 3, 50), again = simulateNoisyFront(type, 3, 50);
    ASSERT_EQ(front.track.observations.size(), 50U);
    for (std::size_t i = 0; i < 50; ++i)
      EXPECT_TRUE(front.track.observations[i].rectangle.pose.isApprox(again.track.observations[i].rectangle.pose, 0));
    // White noise up to 3 mm and slow noise up to 4 mm: five standard deviations are 25 mm.
    EXPECT_LT((front.track.observations[0].rectangle.center() - front.truth.center).norm(), 0.04);
  }
}

}  // namespace
}  // namespace cabinet_articulation::core::evaluation
