// SPDX-License-Identifier: BSD-3-Clause
#include "planes/duplicate_merger.h"

#include <gtest/gtest.h>

namespace cabinet_articulation::core {
namespace {

const cv::Size kImage(640, 480);

/// A rectangle of cells.
void add(const DisparityPlane& plane, const cv::Rect& cells, RegionSet* set) {
  GrownRegion region;
  region.plane = plane;
  region.first_run = static_cast<int>(set->runs.size());
  for (int row = cells.y; row < cells.y + cells.height; ++row) set->runs.push_back({row, cells.x, cells.x + cells.width});
  region.last_run = static_cast<int>(set->runs.size());
  region.cells = cells.area();
  set->regions.push_back(region);
}

TEST(DuplicateMerger, KeepsTheLargestOfOneSurface) {
  RegionSet set;
  add({0, 0, 40.1}, {10, 10, 30, 30}, &set);
  add({0, 0, 40}, {10, 10, 50, 50}, &set);
  DuplicateMerger(PlanesConfig()).process(kImage, &set);
  ASSERT_EQ(set.regions.size(), 1U);
  EXPECT_EQ(set.regions[0].cells, 2500);
}

TEST(DuplicateMerger, SurfacesThatOnlyShareCellsStay) {
  RegionSet set;
  add({0, 0, 40}, {10, 10, 50, 50}, &set);
  add({0, 0, 41}, {10, 10, 30, 30}, &set);  // another depth
  add({0, 0, 40}, {50, 10, 30, 50}, &set);  // a third is shared
  DuplicateMerger(PlanesConfig()).process(kImage, &set);
  EXPECT_EQ(set.regions.size(), 3U);
}

TEST(DuplicateMerger, ADoorAjarIsNotItsNeighbour) {
  RegionSet set;
  add({0, 0, 40}, {10, 10, 110, 60}, &set);
  add({0.005, 0, 39.5}, {60, 10, 80, 60}, &set);  // they meet at u = 100 and share what they agree about
  DuplicateMerger(PlanesConfig()).process(kImage, &set);
  EXPECT_EQ(set.regions.size(), 2U);
}

TEST(DuplicateMerger, OrdersBySizeAndKeepsTheLargest) {
  RegionSet set;
  add({0, 0, 30}, {10, 10, 10, 10}, &set);
  add({0, 0, 40}, {100, 10, 30, 10}, &set);
  add({0, 0, 50}, {200, 10, 20, 10}, &set);
  PlanesConfig config;
  config.max_regions = 2;
  DuplicateMerger(config).process(kImage, &set);
  ASSERT_EQ(set.regions.size(), 2U);
  EXPECT_EQ(set.regions[0].plane.c, 40);
  EXPECT_EQ(set.regions[1].plane.c, 50);
}

}  // namespace
}  // namespace cabinet_articulation::core
