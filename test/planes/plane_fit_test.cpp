// SPDX-License-Identifier: BSD-3-Clause
#include "planes/plane_fit.h"

#include <gtest/gtest.h>

#include <random>

namespace cabinet_articulation::core {
namespace {

const DisparityPlane kPlane{0.04, -0.07, 51.3};

TEST(PlaneFit, IsExactWithoutNoise) {
  PlaneFit fit;
  for (int u = 500; u < 640; u += 20)
    for (int v = 0; v < 60; v += 20) fit.add(u, v, kPlane.at(u, v));
  const DisparityPlane plane = *fit.solve();
  EXPECT_NEAR(plane.a, kPlane.a, 1e-12);
  EXPECT_NEAR(plane.b, kPlane.b, 1e-12);
  EXPECT_NEAR(plane.c, kPlane.c, 1e-9);
  EXPECT_EQ(fit.count(), 21);
}

TEST(PlaneFit, AveragesNoise) {
  std::mt19937 generator(3);
  std::normal_distribution<double> noise(0, 0.2);
  PlaneFit fit;
  for (int u = 100; u < 200; ++u)
    for (int v = 50; v < 150; ++v) fit.add(u, v, kPlane.at(u, v) + noise(generator));
  // 0.2 px / sqrt(10,000 points) is 0.002 px in the middle and twice that at a corner; four sigma.
  for (const int u : {100, 200})
    for (const int v : {50, 150}) EXPECT_NEAR(fit.solve()->at(u, v), kPlane.at(u, v), 4 * 0.0054);
}

TEST(PlaneFit, SumsOfPartsAreThoseOfTheWhole) {
  PlaneFit whole, left, right;
  for (int u = 200; u < 300; u += 10)
    for (int v = 50; v < 150; v += 10) {
      whole.add(u, v, 0.01 * u + (v % 20 ? 0.1 : -0.1));
      (u < 250 ? left : right).add(u, v, 0.01 * u + (v % 20 ? 0.1 : -0.1));
    }
  left.add(right);
  EXPECT_EQ(left.count(), 100);
  EXPECT_NEAR(left.solve()->a, whole.solve()->a, 1e-12);
  EXPECT_EQ(left.meanU(), 245);
  EXPECT_EQ(left.meanV(), 95);
  EXPECT_NEAR(whole.squares({0.01, 0, 0}), 100 * 0.1 * 0.1, 1e-9);
  EXPECT_NEAR(whole.squares({0.01, 0, 0.2}), 50 * (0.3 * 0.3 + 0.1 * 0.1), 1e-9);
}

TEST(PlaneFit, CentredFitsOfParallelPlanesAddUpToOne) {
  PlaneFit low, high;
  for (int u = 200; u < 300; u += 10)
    for (int v = 50; v < 150; v += 10) (u < 230 ? low : high).add(u, v, 0.01 * u - 0.02 * v + (u < 230 ? 7 : 9));
  PlaneFit both = low.centred();
  both.add(high.centred());
  ASSERT_TRUE(both.solve());
  EXPECT_EQ(both.count(), 100);
  EXPECT_NEAR(both.solve()->a, 0.01, 1e-9);
  EXPECT_NEAR(both.solve()->b, -0.02, 1e-9);
  EXPECT_NEAR(both.squares(*both.solve()), 0, 1e-9);
}

TEST(PlaneFit, PointsOnALineGiveNothing) {
  PlaneFit fit;
  EXPECT_FALSE(fit.solve());
  for (int i = 0; i < 50; ++i) fit.add(10 * i, 5 * i + 3, 40);
  EXPECT_FALSE(fit.solve());
  fit.add(100, 200, 40);
  EXPECT_TRUE(fit.solve());
}

}  // namespace
}  // namespace cabinet_articulation::core
