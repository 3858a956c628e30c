// SPDX-License-Identifier: BSD-3-Clause
#include "planes/region_growing.h"

#include <gtest/gtest.h>

#include <limits>

#include "cabinet_articulation/planes/plane_segmenter.h"
#include "planes/fold_search.h"
#include "planes/region_competition.h"
#include "stereo/synthetic_pair.h"

namespace cabinet_articulation::core {
namespace {

const DisparityPlane kPlane{0.01, -0.02, 40};
const DisparityPlane kFar{0, 0, 20};

DepthFrame frameOf(const std::vector<std::pair<DisparityPlane, cv::Rect>>& surfaces) {
  DepthFrame frame;
  frame.camera = testCamera();
  frame.disparity = cv::Mat1f(480, 640, 0.0F);
  for (const auto& surface : surfaces)
    for (int v = surface.second.y; v < surface.second.y + surface.second.height; ++v)
      for (int u = surface.second.x; u < surface.second.x + surface.second.width; ++u)
        frame.disparity(v, u) = static_cast<float>(surface.first.at(u, v));
  return frame;
}

cv::Rect boxOf(const GrownRegion& region, const RegionSet& set) {
  int left = 1 << 20, right = 0;
  for (int i = region.first_run; i < region.last_run; ++i) {
    left = std::min(left, set.runs[i].begin);
    right = std::max(right, set.runs[i].end);
  }
  const int top = set.runs[region.first_run].row, bottom = set.runs[region.last_run - 1].row + 1;
  return {kCell * left, kCell * top, kCell * (right - left), kCell * (bottom - top)};
}

TEST(RegionGrowing, SplitsAPlaneIntoItsConnectedPieces) {
  const cv::Rect first(20, 30, 100, 60), second(130, 30, 80, 50), small(300, 300, 18, 18);
  const DepthFrame frame = frameOf({{kPlane, first}, {kPlane, second}, {kPlane, small}});
  RegionGrowing growing{PlanesConfig()};
  const RegionSet& set = growing.process(frame, {kPlane});
  ASSERT_EQ(set.regions.size(), 2U) << "18x18 pixels are less than min_region";
  EXPECT_EQ(boxOf(set.regions[0], set), first) << "the erosion was given back";
  EXPECT_EQ(boxOf(set.regions[1], set), second);
  EXPECT_EQ(set.regions[0].cells * kCell * kCell, first.area());
}

TEST(RegionGrowing, ThinBridgesDoNotConnect) {
  const DepthFrame frame = frameOf({{kPlane, {20, 30, 100, 60}}, {kPlane, {120, 50, 30, 4}}, {kPlane, {150, 30, 80, 60}}});
  RegionGrowing growing{PlanesConfig()};
  EXPECT_EQ(growing.process(frame, {kPlane}).regions.size(), 2U);
}

TEST(RegionGrowing, HolesDoNotTearARegion) {
  const cv::Rect area(100, 100, 200, 120);
  const auto regionOf = [&](const DepthFrame& frame) {
    RegionGrowing growing{PlanesConfig()};
    const RegionSet set = growing.process(frame, {kPlane});
    EXPECT_EQ(set.regions.size(), 1U);
    return set;
  };
  const DepthFrame whole = frameOf({{kPlane, area}});
  DepthFrame regular = whole, random = whole;
  regular.disparity = whole.disparity.clone();
  random.disparity = whole.disparity.clone();
  cv::RNG draw(1);
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u) {
      if (u % 3 == 0 && v % 3 == 0) regular.disparity(v, u) = 0;
      if (draw.uniform(0, 5) == 0) random.disparity(v, u) = std::numeric_limits<float>::quiet_NaN();
    }
  for (const DepthFrame* frame : {&regular, &random}) {
    const RegionSet set = regionOf(*frame);
    EXPECT_EQ(boxOf(set.regions.at(0), set), area);
    EXPECT_GT(set.regions[0].cells * kCell * kCell, 0.98 * area.area());
    // A pixel that stands in for its neighbour is off by the plane's slope at most.
    EXPECT_NEAR(set.regions[0].plane.at(200, 160), kPlane.at(200, 160), 0.01);
  }
}

TEST(RegionGrowing, EachPieceGetsItsOwnPlane) {
  const DisparityPlane steeper{kPlane.a + 0.002, kPlane.b, kPlane.c - 0.4};
  const DepthFrame frame = frameOf({{kPlane, {20, 30, 100, 60}}, {steeper, {150, 30, 100, 60}}});
  RegionGrowing growing{PlanesConfig()};
  const RegionSet& set = growing.process(frame, {kPlane});
  ASSERT_EQ(set.regions.size(), 2U);
  // Float disparities of 40 px are good to 4e-6 px.
  EXPECT_NEAR(set.regions[0].plane.a, kPlane.a, 1e-6);
  EXPECT_NEAR(set.regions[1].plane.a, steeper.a, 1e-6);
}

TEST(RegionGrowing, TrimmedRegionsLeaveOthersTheirPixels) {
  // The planes cross at u = 200. Within the tolerance each reaches into the other's surface.
  const DisparityPlane left{0, 0, 40}, right{-0.03, 0, 46};
  const DepthFrame frame = frameOf({{left, {100, 100, 100, 80}}, {right, {200, 100, 100, 80}}});
  PlanesConfig config;
  RegionGrowing growing{config};
  RegionCompetition competition{config};
  RegionSet& set = growing.process(frame, {left, right});
  ASSERT_EQ(set.regions.size(), 2U);
  EXPECT_GT(boxOf(set.regions[0], set).br().x, 212) << "0.5 px / 0.03";
  set.regions[0].plane = left;
  set.regions[1].plane = right;
  growing.trim(competition.processCells(growing.cells(), set));
  ASSERT_EQ(set.regions.size(), 2U);
  // 0.15 px / 0.03 = 5 px remain disputed, and cells have 2 px.
  EXPECT_NEAR(boxOf(set.regions[0], set).br().x, 205, 2);
  EXPECT_NEAR(boxOf(set.regions[1], set).x, 195, 2);
  EXPECT_EQ(boxOf(set.regions[0], set).x, 100);
}

TEST(RegionGrowing, ABentRegionBecomesTwoThatMeetAtTheFold) {
  // A door ajar at u = 200 and its neighbour, and apart from both a larger front in the neighbour's plane. The plane between
  // the first two holds most of both.
  const DisparityPlane fixed{0, 0, 40}, ajar{0.006, 0, 38.8}, between{0.003, 0, 39.6};
  const DepthFrame frame = frameOf({{fixed, {100, 100, 100, 200}}, {ajar, {200, 100, 160, 200}}, {fixed, {400, 50, 220, 400}}});
  RegionGrowing growing{PlanesConfig()};
  FoldSearch folds;
  ASSERT_EQ(growing.process(frame, {between}).regions.size(), 1U);
  const RegionSet& set = growing.unfold(frame.camera, 0, &folds);
  ASSERT_EQ(set.regions.size(), 2U);
  for (const GrownRegion& region : set.regions) {
    const bool is_door = boxOf(region, set).br().x > 300;
    // Where the planes meet is known to within a block of 16 px.
    EXPECT_EQ(boxOf(region, set).br().x, is_door ? 360 : boxOf(region, set).br().x) << "also what the first plane missed";
    EXPECT_NEAR(is_door ? boxOf(region, set).x : boxOf(region, set).br().x, 200, 16);
    EXPECT_NEAR(region.plane.a, is_door ? ajar.a : fixed.a, 3e-4);
  }
}

TEST(RegionGrowing, AFlatRegionStaysAsItIs) {
  const DepthFrame frame = frameOf({{kPlane, {100, 100, 300, 200}}});
  RegionGrowing growing{PlanesConfig()};
  FoldSearch folds;
  growing.process(frame, {kPlane});
  const RegionSet& set = growing.unfold(frame.camera, kMostBend, &folds);
  ASSERT_EQ(set.regions.size(), 1U);
  EXPECT_EQ(boxOf(set.regions[0], set), cv::Rect(100, 100, 300, 200));
}

TEST(RegionGrowing, NothingGrowsWhereNothingWasMeasured) {
  RegionGrowing growing{PlanesConfig()};
  EXPECT_TRUE(growing.process(frameOf({}), {kPlane}).regions.empty());
  EXPECT_TRUE(growing.process(frameOf({{kFar, {0, 0, 640, 480}}}), {kPlane}).regions.empty());
  DepthFrame row = frameOf({});
  row.disparity = cv::Mat1f(1, 640, 40.0F);
  EXPECT_TRUE(growing.process(row, {{0, 0, 40}}).regions.empty());
  PlanesConfig bad;
  bad.min_region = 0;
  EXPECT_THROW(RegionGrowing{bad}, ConfigError);
}

}  // namespace
}  // namespace cabinet_articulation::core
