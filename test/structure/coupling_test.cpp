// SPDX-License-Identifier: BSD-3-Clause
#include "structure/coupling.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cabinet_articulation::core {
namespace {

constexpr double kSigma = 0.01;  // [m]

/// Doors of 0.4 m, of which the first opens and closes by 1 rad.
template <class Second>
ConfigurationPairs pairs(const Second& second) {
  ConfigurationPairs q;
  q.first_metres = q.second_metres = 0.4;
  for (int i = 0; i <= 100; ++i) {
    const double time = i / 100.0;
    q.first.push_back(std::sin(M_PI * time));
    q.second.push_back(second(time));
  }
  return q;
}

TEST(Coupling, LeavesOfAFoldingDoorHaveOneDegreeOfFreedom) {
  const auto ratio =
      ratioOfCoupled(pairs([](double time) { return 2 * std::sin(M_PI * time) + 0.01 * std::sin(50 * time); }), kSigma);
  ASSERT_TRUE(ratio);
  EXPECT_NEAR(*ratio, 2, 0.05);
}

TEST(Coupling, FrontsThatMoveInTurnHaveTwo) {
  EXPECT_FALSE(ratioOfCoupled(pairs([](double time) { return time < 0.8 ? 0 : 5 * (time - 0.8); }), kSigma));
}

TEST(Coupling, FrontsThatAreOpenedAtOnceByTwoHandsHaveTwo) {
  EXPECT_FALSE(ratioOfCoupled(pairs([](double time) { return std::sin(M_PI * std::sqrt(time)); }), kSigma));
}

TEST(Coupling, NothingIsSaidOfFrontsThatHardlyMoved) {
  EXPECT_FALSE(ratioOfCoupled(pairs([](double time) { return 0.1 * std::sin(M_PI * time); }), kSigma));
  EXPECT_FALSE(ratioOfCoupled({}, kSigma));
}

}  // namespace
}  // namespace cabinet_articulation::core
