// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/acceptance/rectangle_acceptance.h"

#include <gtest/gtest.h>

#include "front_scene.h"

namespace cabinet_articulation::core {
namespace {

LabelCounts counts(int in_plane, int free, int occluded, int unknown, int other_plane) {
  LabelCounts result;
  result.in_plane = in_plane;
  result.free = free;
  result.occluded = occluded;
  result.unknown = unknown;
  result.other_plane = other_plane;
  return result;
}

TEST(RectangleAcceptanceTest, PrecisionIsEq4) {
  const RectanglesConfig config;
  EXPECT_DOUBLE_EQ(precision(counts(60, 10, 20, 5, 5), config), (60 + 0.8 * 20 + 0.8 * 5) / 100);
  EXPECT_EQ(precision(LabelCounts(), config), 0);
}

TEST(RectangleAcceptanceTest, RecallIsEq5OfTheRegionAndAtMost1) {
  EXPECT_DOUBLE_EQ(recall(counts(60, 10, 20, 5, 5), 80), 0.75);
  EXPECT_EQ(recall(counts(60, 0, 0, 0, 0), 50), 1);
  EXPECT_EQ(recall(counts(60, 0, 0, 0, 0), 0), 0);
}

TEST(RectangleAcceptanceTest, ARectangleMustFillItsRegion) {
  const RectanglesConfig config;
  DetectedRectangle good;
  good.rectangle = exampleFront({0, 0, 1.3}, 0.4, 0.3, 0, 0, 0);
  good.precision = 0.95;
  good.recall = 0.9;
  const LabelCounts filled = counts(90, 5, 5, 0, 0);
  EXPECT_TRUE(fillsRegion(good, filled, config));
  EXPECT_FALSE(fillsRegion(good, counts(30, 0, 70, 0, 0), config));  // mostly hidden
  DetectedRectangle bad = good;
  bad.precision = 0.8;
  EXPECT_FALSE(fillsRegion(bad, filled, config));
  bad = good;
  bad.recall = 0.6;
  EXPECT_FALSE(fillsRegion(bad, filled, config));
  bad = good;
  bad.rectangle.height = 0.05;
  EXPECT_FALSE(fillsRegion(bad, filled, config));
  bad.rectangle.height = 2.5;
  EXPECT_FALSE(fillsRegion(bad, filled, config));
}

TEST(RectangleAcceptanceTest, TwoEdgesInSumAndOneAcrossEachSideMustBeSeen) {
  const RectanglesConfig config;
  const std::array<bool, 4> none{};
  EXPECT_TRUE(bounded({1, 1, 1, 1}, none, config));
  EXPECT_TRUE(bounded({1, 0, 1, 1}, none, config));
  EXPECT_TRUE(bounded({0.6F, 0.6F, 0.5F, 0.5F}, none, config));
  EXPECT_FALSE(bounded({1, 1, 0, 0.3F}, none, config));  // a strip between two edges: part of something longer
  EXPECT_FALSE(bounded({0.4F, 0.5F, 0.5F, 0.4F}, none, config));
}

TEST(RectangleAcceptanceTest, WhatShowsLessThanHalfOfItsEdgesIsNotRefined) {
  RectanglesConfig config;
  EXPECT_FALSE(mayBeBounded(0.9F, config));
  EXPECT_TRUE(mayBeBounded(1, config));
  EXPECT_TRUE(bounded({0.6F, 0.6F, 0, 0}, {false, false, true, true}, config));
  EXPECT_TRUE(mayBeBounded(0.6F + 0.6F, config)) << "the least that a front shows";
  config.min_observed_edges = 3;
  EXPECT_TRUE(mayBeBounded(0.6F + 0.6F, config)) << "of a front that is cut, two edges are enough";
}

TEST(RectangleAcceptanceTest, OfAFrontThatTheImageCutsTheOtherEdgesMustBeSeen) {
  const RectanglesConfig config;
  EXPECT_TRUE(bounded({0.8F, 0.9F, 0, 0}, {false, false, true, true}, config));
  EXPECT_FALSE(bounded({0.8F, 0.9F, 0, 0}, {false, false, false, true}, config));
  EXPECT_FALSE(bounded({0.9F, 0, 0, 0}, {false, true, true, true}, config));      // a floor or a wall with one end in view
  EXPECT_FALSE(bounded({0.9F, 0, 0.9F, 0}, {false, true, false, true}, config));  // a corner of it
  EXPECT_FALSE(bounded({0.8F, 0.3F, 0, 0}, {false, false, true, true}, config));
  EXPECT_TRUE(
      bounded({1, 1, 0.4F, 0.3F}, {true, false, false, false}, config));  // what is near the border may be seen all the same
  EXPECT_FALSE(bounded({0, 0, 0, 0}, {true, true, true, true}, config));  // a wall
}

TEST(RectangleAcceptanceTest, SameSurfaceComparesPlaneAndPlace) {
  const Rectangle front = exampleFront({0, 0, 1.3}, 0.4, 0.3, 0, 0, 0);
  EXPECT_TRUE(sameSurface(front, exampleFront({0.02, 0, 1.31}, 0.38, 0.3, 0.1, 0, 0)));
  EXPECT_TRUE(sameSurface(front, exampleFront({0, 0, 1.3}, 0.3, 0.4, 0, 0, M_PI_2)));
  EXPECT_FALSE(sameSurface(front, exampleFront({0.3, 0, 1.3}, 0.4, 0.3, 0, 0, 0)));  // beside it
  EXPECT_FALSE(sameSurface(front, exampleFront({0, 0, 1.35}, 0.4, 0.3, 0, 0, 0)));   // behind it
  EXPECT_FALSE(sameSurface(front, exampleFront({0, 0, 1.3}, 0.4, 0.3, 0.5, 0, 0)));  // turned
  EXPECT_FALSE(sameSurface(front, exampleFront({0, 0, 1.3}, 0.15, 0.1, 0, 0, 0)));   // a part of it
}

TEST(RectangleAcceptanceTest, SelectsTheBestSupportedOfEachSurface) {
  RectanglesConfig config;
  std::vector<SupportedRectangle> candidates(4);
  candidates[0].detection.rectangle = exampleFront({0, 0, 1.3}, 0.4, 0.3, 0, 0, 0);
  candidates[0].support = 100;
  candidates[1].detection.rectangle = exampleFront({0, 0.01, 1.3}, 0.4, 0.3, 0, 0, 0);
  candidates[1].support = 200;
  candidates[2].detection.rectangle = exampleFront({1, 0, 1.3}, 0.4, 0.3, 0, 0, 0);
  candidates[2].support = 300;
  candidates[3].detection.rectangle = exampleFront({-1, 0, 1.3}, 0.4, 0.3, 0, 0, 0);
  candidates[3].support = 50;
  for (int i = 0; i < 4; ++i) candidates[i].detection.region = i;
  const auto regionsOf = [&] {
    std::vector<int> regions;
    for (const DetectedRectangle& rectangle : selectBest(candidates, config)) regions.push_back(rectangle.region);
    return regions;
  };
  EXPECT_EQ(regionsOf(), (std::vector<int>{2, 1, 3}));
  config.max_rectangles = 2;
  EXPECT_EQ(regionsOf(), (std::vector<int>{2, 1}));
  candidates[3].tracked = true;  // a live track is worth more than support
  EXPECT_EQ(regionsOf(), (std::vector<int>{2, 3}));
}

}  // namespace
}  // namespace cabinet_articulation::core
