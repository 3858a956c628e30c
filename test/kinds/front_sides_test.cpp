// SPDX-License-Identifier: BSD-3-Clause
#include "kinds/front_sides.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cabinet_articulation::core {
namespace {

JointShape ofSize(double width, double height) {
  JointShape shape;
  shape.width = width;
  shape.height = height;
  return shape;
}

/// The chain rule.
TEST(FrontSides, EvidenceOfTwoIsTheDensityOfTheSecondOnceTheFirstIsKnown) {
  const FrontSides one({ofSize(0.4, 0.6)}, {}), two({ofSize(0.4, 0.6), ofSize(0.43, 0.52)}, {});
  EXPECT_NEAR(two.logEvidence(), one.logEvidence() + one.logDensity(0.43, 0.52), 1e-9);
}

TEST(FrontSides, DensityOfTheNextFrontIsOneInAll) {
  const FrontSides sides({ofSize(0.4, 0.6), ofSize(0.43, 0.52)}, {});
  constexpr double kStep = 0.02, kRange = 4;
  double sum = 0;
  for (double a = -kRange; a < kRange; a += kStep)
    for (double b = -kRange; b < kRange; b += kStep)
      sum += kStep * kStep * std::exp(sides.logDensity(0.4 * std::exp(a), 0.6 * std::exp(b)));
  EXPECT_NEAR(sum, 1, 0.01);
}

TEST(FrontSides, OfNoKnownSizeSayNothing) {
  const FrontSides sides({ofSize(0, 0)}, {});
  EXPECT_EQ(sides.logEvidence(), 0);
  EXPECT_EQ(sides.logDensity(0.4, 0.6), FrontSides::logDensityOfAny());
}

}  // namespace
}  // namespace cabinet_articulation::core
