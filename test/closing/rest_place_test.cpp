// SPDX-License-Identifier: BSD-3-Clause
#include "closing/rest_place.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cabinet_articulation::core {
namespace {

constexpr double kReach = 0.8;                // [m]
constexpr Correction kSurface{0, 0.003};      // flush as kitchens are
constexpr double kMillimetre = 0.001;         // [m]
constexpr double kSigma = 0.4 * kMillimetre;  // of a view

std::vector<Correction> views(const std::vector<double>& millimetres) {
  std::vector<Correction> measured;
  for (const double q : millimetres) measured.push_back({q * kMillimetre, kSigma});
  return measured;
}

TEST(RestPlace, IsNotPulledOutByAFrontThatBeginsToOpen) {
  const auto rest = innermostRest(views({0.1, -0.2, 0.2, 0, 0.2, 1.7, 5.4}), kSurface, kReach);
  ASSERT_TRUE(rest);
  EXPECT_NEAR(rest->place.q, 0.06 * kMillimetre, 0.2 * kMillimetre) << "their mean is 1.06";
  EXPECT_EQ(rest->views, 5);
  EXPECT_NEAR(rest->place.sigma, kSigma / std::sqrt(5), 0.02 * kMillimetre);
}

TEST(RestPlace, IsNotPulledInByOneViewThatIsWrong) {
  const auto rest = innermostRest(views({-6, 0.1, -0.2, 0.2, 0}), kSurface, kReach);
  ASSERT_TRUE(rest);
  EXPECT_NEAR(rest->place.q, 0, 0.2 * kMillimetre);
  EXPECT_EQ(rest->views, 4);
}

TEST(RestPlace, IsTheInnermostOfTwo) {
  const auto rest = innermostRest(views({-2, -2.1, -1.9, 4, 4.1, 3.9}), kSurface, kReach);
  ASSERT_TRUE(rest);
  EXPECT_NEAR(rest->place.q, -2 * kMillimetre, 0.1 * kMillimetre) << "a drawer may be left ajar";
}

TEST(RestPlace, OfNoisyViewsIsNearTheSurface) {
  const auto rest = innermostRest({{0.01, 0.02}, {0.012, 0.02}}, kSurface, kReach);
  ASSERT_TRUE(rest);
  EXPECT_NEAR(rest->place.q, 0.45 * kMillimetre, 0.05 * kMillimetre) << "their mean counts 4 %, the surface the rest";
}

/// One step would put it halfway, where neither the view nor the surface has it.
TEST(RestPlace, IsOnlyFoundOnceItDoesNotMoveAnyMore) {
  const auto rest = innermostRest({{0.02, 0.003}}, kSurface, kReach);
  ASSERT_TRUE(rest);
  EXPECT_NEAR(rest->place.q, 0, 0.1 * kMillimetre) << "the front was on its way";
  EXPECT_EQ(rest->views, 0);
}

TEST(RestPlace, NeedsAView) { EXPECT_FALSE(innermostRest({}, kSurface, kReach)); }

}  // namespace
}  // namespace cabinet_articulation::core
