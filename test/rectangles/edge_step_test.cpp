// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/edges/edge_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "edge_profiles.h"

namespace cabinet_articulation::core {
namespace {

TEST(EdgeStepTest, FindsASharpEdge) {
  for (const double edge : {-9.0, -2.5, 0.0, 3.0}) {
    const EdgeStep step = findStep(profileOf([edge](double x) { return x < edge ? 0 : kNone; }));
    EXPECT_NEAR(step.offset, edge, 0.5);
    EXPECT_GT(step.contrast, 3);
    EXPECT_NEAR(step.inside, std::log(0.02), 0.1);
  }
}

TEST(EdgeStepTest, HalfOfTheSignalPlacesAnEdgeBetweenStrips) {
  // In a shadow little blur makes both images agree: the strips follow the plane for a pixel beyond the edge.
  for (const double edge : {-3.1, 0.0, 0.2, 2.4}) {
    EdgeProfile::Residuals residuals = profileOf([edge](double x) { return x < edge + 1 ? 0 : kNone; });
    for (int k = 0; k < EdgeProfile::kStrips; ++k) {
      const double outward = EdgeProfile::offset(k) + EdgeProfile::kStripWidth / 2 - edge;
      residuals.signal[k] = static_cast<float>(40 * std::clamp(0.5 - outward / 2, 0.0, 1.0));  // blur of two pixels
    }
    EXPECT_NEAR(findStep(residuals).offset, edge, 0.05);
  }
}

TEST(EdgeStepTest, FindsWhereASideFaceBegins) {
  for (const double slope : {-0.1, -0.2, -0.4}) {
    const EdgeStep step = findStep(profileOf([slope](double x) { return x < -4 ? 0 : slope * (x + 4); }), {slope, 0});
    EXPECT_NEAR(step.offset, -4, 1) << slope;
    EXPECT_TRUE(step.face);
  }
}

TEST(EdgeStepTest, PrefersTheSideFaceToTheStepBehindIt) {
  // The thickness of a door, then the room.
  const EdgeStep step = findStep(profileOf([](double x) { return x < -2 ? 0 : x < 3 ? -0.25 * (x + 2) : kNone; }), {-0.25, 0});
  EXPECT_NEAR(step.offset, -2, 1);
  EXPECT_TRUE(step.face);
}

TEST(EdgeStepTest, SeesNoSideFaceWhereThePlaneGoesOn) {
  const auto front = profileOf([](double x) { return x < 3 ? 0 : kNone; });
  for (const double slope : {-0.1, -0.4, -0.9}) {
    const EdgeStep step = findStep(front, {slope, 0});
    EXPECT_FALSE(step.face) << slope;
    EXPECT_NEAR(step.offset, 3, 0.5) << slope;
  }
}

TEST(EdgeStepTest, TellsANeighbourThatLiesAPixelBehind) {
  const EdgeStep step = findStep(profileOf([](double x) { return x < 1 ? 0 : -0.8; }));
  EXPECT_NEAR(step.offset, 1, 1);
  EXPECT_GT(step.contrast, 1);
}

TEST(EdgeStepTest, HasNoContrastOnOneSurface) {
  EXPECT_LT(findStep(profileOf([](double) { return 0; })).contrast, 0.1);
}

TEST(EdgeStepTest, SaysNothingWithoutPixels) {
  EdgeProfile::Residuals empty = profileOf([](double) { return 0; });
  empty.weight.fill(0);
  EXPECT_EQ(findStep(empty).contrast, 0);
}

}  // namespace
}  // namespace cabinet_articulation::core
