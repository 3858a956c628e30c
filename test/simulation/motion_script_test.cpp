// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/simulation/motion_script.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace cabinet_articulation::core {
namespace {

const MotionScript kTwoMoves({{0, 0.3, 1, 2, 0.5, 2}, {1, 1.4, 7, 2, 0.5, 3}}, 1);

TEST(MotionScript, OpensStaysAndCloses) {
  EXPECT_EQ(kTwoMoves.q(0, 0), 0);
  EXPECT_EQ(kTwoMoves.q(0, 1), 0);
  EXPECT_NEAR(kTwoMoves.q(0, 2), 0.15, 1e-12);
  EXPECT_NEAR(kTwoMoves.q(0, 3.25), 0.3, 1e-12);
  EXPECT_NEAR(kTwoMoves.q(0, 4.5), 0.15, 1e-12);
  EXPECT_NEAR(kTwoMoves.q(0, 5.5), 0, 1e-12);
}

TEST(MotionScript, JointsMoveInTheirOwnTime) {
  EXPECT_EQ(kTwoMoves.q(1, 3), 0);
  EXPECT_EQ(kTwoMoves.q(0, 9), 0);
  EXPECT_NEAR(kTwoMoves.q(1, 9.2), 1.4, 1e-12);
  EXPECT_DOUBLE_EQ(kTwoMoves.duration(), 13.5);
}

TEST(MotionScript, HasNoJerks) {
  // Acceleration of a step of 0.3 m in 2 s stays below 5.78 q / T^2 (the quintic's maximum) = 0.43 m/s^2.
  constexpr double kStep = 0.01;
  for (double t = 0; t < kTwoMoves.duration(); t += kStep) {
    const double acceleration = (kTwoMoves.q(0, t + kStep) - 2 * kTwoMoves.q(0, t) + kTwoMoves.q(0, t - kStep)) / (kStep * kStep);
    EXPECT_LT(std::abs(acceleration), 0.44) << "at " << t;
  }
}

TEST(MotionScript, HandArrivesBeforeAndLeavesAfterTheMove) {
  EXPECT_FALSE(kTwoMoves.hand(0.1));
  ASSERT_TRUE(kTwoMoves.hand(0.6));
  EXPECT_GT(kTwoMoves.hand(0.6)->away, 0.1);
  for (double t = 1; t <= 5.5; t += 0.25) {
    ASSERT_TRUE(kTwoMoves.hand(t));
    EXPECT_EQ(kTwoMoves.hand(t)->away, 0);
    EXPECT_EQ(kTwoMoves.hand(t)->joint, 0);
  }
  EXPECT_FALSE(kTwoMoves.hand(6.31).has_value() && kTwoMoves.hand(6.31)->joint == 0);
  EXPECT_EQ(kTwoMoves.hand(7)->joint, 1);
}

TEST(MotionScript, WithoutMovesIsStill) {
  const MotionScript still({}, 2);
  EXPECT_EQ(still.q(0, 1), 0);
  EXPECT_FALSE(still.hand(1));
  EXPECT_EQ(still.duration(), 2);
}

TEST(MotionScript, RefusesNegativeDurations) { EXPECT_THROW(MotionScript({{0, 1, 1, -1, 0, 1}}), std::invalid_argument); }

}  // namespace
}  // namespace cabinet_articulation::core
