// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/history.h"

#include <gtest/gtest.h>

#include "cabinet_articulation/tracking/motion_gate.h"
#include "tracking/synthetic_fronts.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kFrame = 1.0 / 15;

std::vector<TrackedObservation> historyOf(const std::vector<Rectangle>& places) {
  std::vector<TrackedObservation> history(places.size());
  for (size_t i = 0; i < places.size(); ++i) {
    history[i].stamp = i * kFrame;
    history[i].rectangle = places[i];
  }
  return history;
}

TEST(Extrapolate, KeepsTheVelocityUpToTheHorizon) {
  std::vector<Rectangle> places;
  for (int i = 0; i < 10; ++i) places.push_back(pulled(closedFront(), 0.02 * i));
  const auto history = historyOf(places);
  const double last = history.back().stamp;
  EXPECT_LT((extrapolate(history, last + kFrame, 0.3).center() - pulled(closedFront(), 0.2).center()).norm(), 1e-9);
  EXPECT_LT((extrapolate(history, last + 10, 3 * kFrame).center() - pulled(closedFront(), 0.24).center()).norm(), 1e-9);
  EXPECT_LT((extrapolate(history, last - 1, 0.3).center() - places.back().center()).norm(), 1e-9);
}

TEST(Extrapolate, TurnsOn) {
  std::vector<Rectangle> places;
  for (int i = 0; i < 10; ++i) places.push_back(swung(closedFront(), 0.1 * i));
  const auto history = historyOf(places);
  const Rectangle predicted = extrapolate(history, history.back().stamp + kFrame, 0.3);
  EXPECT_LT(angleBetween(predicted.pose, swung(closedFront(), 1.0).pose), 1e-9);
  EXPECT_LT((predicted.center() - swung(closedFront(), 1.0).center()).norm(), 0.004) << "the chord of the arc";
}

TEST(Extrapolate, OneObservationStandsStill) {
  const auto history = historyOf({closedFront()});
  EXPECT_TRUE(extrapolate(history, 5, 0.3).pose.isApprox(closedFront().pose));
}

TEST(ThinOut, ForgetsStandingStillAndKeepsTheMotion) {
  std::vector<Rectangle> places(150, closedFront());
  for (int i = 0; i < 50; ++i) places.push_back(pulled(closedFront(), 0.006 * i));
  for (int i = 0; i < 200; ++i) places.push_back(pulled(closedFront(), 0.3));
  auto history = historyOf(places);
  EXPECT_FALSE(thinOut(history, 400));
  EXPECT_EQ(history.size(), 400u);
  EXPECT_TRUE(thinOut(history, 399));
  EXPECT_EQ(history.size(), 400u - 399 / 4);
  int moving = 0;
  for (size_t i = 0; i < history.size(); ++i) {
    EXPECT_TRUE(i == 0 || history[i].stamp > history[i - 1].stamp);
    moving += history[i].stamp > 149.5 * kFrame && history[i].stamp < 199.5 * kFrame;
  }
  EXPECT_EQ(moving, 50);
  EXPECT_EQ(history.back().stamp, 399 * kFrame);
}

}  // namespace
}  // namespace cabinet_articulation::core
