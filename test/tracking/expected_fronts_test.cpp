// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/expected_fronts.h"

#include <gtest/gtest.h>

#include "tracking/synthetic_fronts.h"

namespace cabinet_articulation::core {
namespace {

TEST(ExpectedFront, KeepsTheVelocityUpToTheHorizon) {
  std::vector<Rectangle> places;
  for (int i = 0; i < 10; ++i) places.push_back(pulled(closedFront(), 0.02 * i));
  const auto history = historyOf(places);
  const double last = history.back().stamp;
  EXPECT_LT((newestMotion(history).at(last + kFrame, 0.3).center() - pulled(closedFront(), 0.2).center()).norm(), 1e-9);
  EXPECT_LT((newestMotion(history).at(last + 10, 3 * kFrame).center() - pulled(closedFront(), 0.24).center()).norm(), 1e-9);
  EXPECT_LT((newestMotion(history).at(last - 1, 0.3).center() - places.back().center()).norm(), 1e-9);
}

TEST(ExpectedFront, TurnsOn) {
  std::vector<Rectangle> places;
  for (int i = 0; i < 10; ++i) places.push_back(swung(closedFront(), 0.1 * i));
  const auto history = historyOf(places);
  const Rectangle predicted = newestMotion(history).at(history.back().stamp + kFrame, 0.3);
  EXPECT_LT(angleBetween(predicted.pose, swung(closedFront(), 1.0).pose), 1e-9);
  EXPECT_LT((predicted.center() - swung(closedFront(), 1.0).center()).norm(), 0.004) << "the chord of the arc";
}

TEST(ExpectedFront, OneObservationStandsStill) {
  const auto history = historyOf({closedFront()});
  EXPECT_TRUE(newestMotion(history).at(5, 0.3).pose.isApprox(closedFront().pose));
}

TEST(ExpectedFronts, ArePredictedToTheSameTime) {
  std::vector<Rectangle> places;
  for (int i = 0; i < 10; ++i) places.push_back(pulled(closedFront(), 0.02 * i));
  const auto history = historyOf(places);
  const double stamp = history.back().stamp + kFrame;
  const ExpectedFronts expected{0.3, {newestMotion(history), newestMotion(historyOf({closedFront()}))}};
  const std::vector<Rectangle> there = expected.at(stamp);
  ASSERT_EQ(there.size(), 2u);
  EXPECT_LT((there[0].center() - pulled(closedFront(), 0.2).center()).norm(), 1e-9);
  EXPECT_LT((there[1].center() - closedFront().center()).norm(), 1e-12);
}

}  // namespace
}  // namespace cabinet_articulation::core
