// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/front_size.h"

#include <gtest/gtest.h>

namespace cabinet_articulation::core {
namespace {

DetectedRectangle sized(double width, double height, std::array<float, 4> support = {1, 1, 1, 1}) {
  DetectedRectangle detection;
  detection.rectangle.width = width;
  detection.rectangle.height = height;
  detection.edge_support = support;
  return detection;
}

TEST(LengthEstimate, IsTheWeightedMedian) {
  LengthEstimate length;
  EXPECT_EQ(length.median(), 0);
  length.add(0.3, 1);
  EXPECT_NEAR(length.median(), 0.3, 1e-4);
  length.add(0.4, 1);
  length.add(0.9, 1);
  EXPECT_NEAR(length.median(), 0.4, 1e-4);
  for (int i = 0; i < 3; ++i) length.add(0.3, 0.9);
  EXPECT_NEAR(length.median(), 0.3, 1e-4);
}

TEST(LengthEstimate, UnobservedLengthsCountOnlyAmongThemselves) {
  LengthEstimate length;
  for (int i = 0; i < 1000; ++i) length.add(0.5 + 0.001 * (i % 3), 0);
  EXPECT_NEAR(length.median(), 0.501, 1e-3);
  EXPECT_EQ(length.weight(), 0);
  length.add(0.4, 0.5);
  EXPECT_NEAR(length.median(), 0.4, 1e-4);
}

TEST(LengthEstimate, SpreadIsThatOfTheCentralTwoThirds) {
  LengthEstimate length;
  for (int i = -100; i <= 100; ++i) length.add(0.5 + 1e-3 * i, 1);
  EXPECT_NEAR(length.spread(), 0.068, 1e-3);
}

TEST(FrontSize, ToleranceShrinksWithCertainty) {
  const TrackingConfig config;
  FrontSize size;
  size.add(sized(0.4, 0.6));
  const DetectedRectangle wide = sized(0.47, 0.6);
  EXPECT_TRUE(size.fits(wide, config)) << "after one observation the front may still be 7 cm wider";
  for (int i = 0; i < 50; ++i) size.add(sized(0.4, 0.6));
  EXPECT_FALSE(size.fits(wide, config));
  EXPECT_TRUE(size.fits(sized(0.43, 0.6), config));
  EXPECT_FALSE(size.fits(sized(0.6, 0.4), config)) << "a quarter turn is another front";
}

TEST(FrontSize, AnUnobservedEdgeDoesNotBreakTheGate) {
  const TrackingConfig config;
  FrontSize size;
  for (int i = 0; i < 50; ++i) size.add(sized(0.4, 0.6));
  EXPECT_TRUE(size.fits(sized(0.2, 0.6, {0, 1, 1, 1}), config)) << "half hidden";
  EXPECT_TRUE(size.fits(sized(0.53, 0.6, {1, 0.2F, 1, 1}), config)) << "merged with its neighbour";
  EXPECT_FALSE(size.fits(sized(0.2, 0.6), config)) << "both edges seen";
  EXPECT_FALSE(size.fits(sized(1.5, 0.6, {0, 0, 1, 1}), config)) << "a wall is no front";
  size.add(sized(0.2, 0.6, {0, 1, 1, 1}));
  EXPECT_NEAR(size.known(config).value.x(), 0.4, 1e-3);
}

TEST(FrontSize, ABetterObservedLengthOutweighsWorseOnes) {
  FrontSize size;
  for (int i = 0; i < 3; ++i) size.add(sized(0.68, 0.6, {0.1F, 0.9F, 1, 1}));
  size.add(sized(0.4, 0.6, {0.45F, 0.9F, 1, 1}));
  EXPECT_NEAR(size.known(TrackingConfig()).value.x(), 0.4, 1e-3);
}

TEST(FrontSize, ALengthThatWasNeverObservedBindsNobody) {
  const TrackingConfig config;
  FrontSize size;
  for (int i = 0; i < 3; ++i) size.add(sized(0.68, 0.6, {0, 1, 1, 1}));  // merged with its neighbour while closed
  EXPECT_TRUE(size.fits(sized(0.4, 0.6), config));
  EXPECT_NEAR(size.known(config).sigma.x(), 0.3, 1e-3);
  EXPECT_LT(size.known(config).sigma.y(), 0.02);
}

}  // namespace
}  // namespace cabinet_articulation::core
