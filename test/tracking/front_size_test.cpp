// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/size/front_size.h"

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
  EXPECT_LT(length.bestWeight(), 1e-5);
  length.add(0.4, 0.5);
  EXPECT_NEAR(length.median(), 0.4, 1e-4);
}

TEST(LengthEstimate, CountsEqualWeights) {
  LengthEstimate length;
  for (int i = 0; i < 7; ++i) length.add(0.5, 0.2);
  EXPECT_NEAR(length.count(), 7, 1e-9);
  for (int i = 0; i < 2; ++i) length.add(0.5, 0.001);
  EXPECT_NEAR(length.count(), 7, 0.1);
}

TEST(LengthEstimate, SpreadIsTheWeightedDeviation) {
  LengthEstimate length;
  EXPECT_EQ(length.spread(), 0);
  for (int i = 0; i < 10; ++i) {
    length.add(0.4, 1);
    length.add(0.5, 1);
    length.add(9, 0);
  }
  EXPECT_NEAR(length.spread(), 0.05, 0.01);
}

TEST(LengthEstimate, RoundingDoesNotMakeTheSpreadANumberThatIsNone) {
  for (int i = 1; i < 1000; ++i) {
    LengthEstimate length;
    length.add(0.1 + 0.00037 * i, 1.0 / i);
    EXPECT_LT(length.spread(), 1e-6) << i;
  }
}

TEST(FrontSize, ToleranceShrinksWithCertainty) {
  const TrackingConfig config;
  FrontSize size(config);
  size.add(sized(0.4, 0.6));
  const DetectedRectangle wide = sized(0.47, 0.6);
  EXPECT_TRUE(size.fits(wide)) << "after one observation the front may still be 7 cm wider";
  for (int i = 0; i < 50; ++i) size.add(sized(0.4, 0.6));
  EXPECT_FALSE(size.fits(wide));
  EXPECT_TRUE(size.fits(sized(0.415, 0.6)));
  EXPECT_FALSE(size.fits(sized(0.43, 0.6))) << "edges that are seen err by millimetres";
  EXPECT_FALSE(size.fits(sized(0.6, 0.4))) << "a quarter turn is another front";
}

TEST(FrontSize, AnUnobservedEdgeDoesNotBreakTheGate) {
  const TrackingConfig config;
  FrontSize size(config);
  for (int i = 0; i < 50; ++i) size.add(sized(0.4, 0.6));
  EXPECT_TRUE(size.fits(sized(0.2, 0.6, {0, 1, 1, 1}))) << "half hidden";
  EXPECT_TRUE(size.fits(sized(0.53, 0.6, {1, 0.2F, 1, 1}))) << "merged with its neighbour";
  EXPECT_FALSE(size.fits(sized(0.2, 0.6))) << "both edges seen";
  EXPECT_FALSE(size.fits(sized(1.5, 0.6, {0, 0, 1, 1}))) << "a wall is no front";
  size.add(sized(0.2, 0.6, {0, 1, 1, 1}));
  EXPECT_NEAR(size.known().value.x(), 0.4, 1e-3);
}

TEST(FrontSize, ABetterObservedLengthOutweighsWorseOnes) {
  const TrackingConfig config;
  FrontSize size(config);
  for (int i = 0; i < 3; ++i) size.add(sized(0.68, 0.6, {0.1F, 0.9F, 1, 1}));
  size.add(sized(0.4, 0.6, {0.45F, 0.9F, 1, 1}));
  EXPECT_NEAR(size.known().value.x(), 0.4, 1e-3);
}

TEST(FrontSize, ALengthThatWasNeverObservedBindsNobody) {
  const TrackingConfig config;
  FrontSize size(config);
  for (int i = 0; i < 3; ++i) size.add(sized(0.68, 0.6, {0, 1, 1, 1}));  // merged with its neighbour while closed
  EXPECT_TRUE(size.fits(sized(0.4, 0.6)));
  EXPECT_GT(size.known().sigma.x(), 0.1);
  EXPECT_LT(size.known().sigma.y(), 0.02);
}

TEST(FrontSize, ManyUnseenEdgesSayMoreThanAFewDoubtfulOnes) {
  const TrackingConfig config;
  FrontSize size(config);
  for (double width : {0.437, 0.35, 0.446, 0.419}) size.add(sized(width, 0.6, {0.2F, 0.6F, 1, 1}));  // hardly open
  for (int i = 0; i < 60; ++i) size.add(sized(0.39 + 0.001 * (i % 10), 0.6, {0, 0.9F, 1, 1}));
  EXPECT_NEAR(size.known().value.x(), 0.395, 0.005);
}

TEST(FrontSize, HoursHalfHiddenDoNotOutweighAMinute) {
  const TrackingConfig config;
  FrontSize size(config);
  for (int i = 0; i < 60; ++i) size.add(sized(0.4, 0.6));
  for (int i = 0; i < 100000; ++i) size.add(sized(0.2, 0.6, {0, 1, 1, 1}));
  EXPECT_NEAR(size.known().value.x(), 0.4, 1e-3);
}

}  // namespace
}  // namespace cabinet_articulation::core
