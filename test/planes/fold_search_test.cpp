// SPDX-License-Identifier: BSD-3-Clause
#include "planes/fold_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "cabinet_articulation/planes/plane_segmenter.h"
#include "stereo/synthetic_pair.h"

namespace cabinet_articulation::core {
namespace {

using Surface = std::function<double(double u, double v)>;

const cv::Rect kArea(100, 80, 300, 280);
const DisparityPlane kFixed{0.02, -0.01, 45};

/// A door whose hinge is at u = 200 leaves the plane of its neighbours by this many pixels per pixel, between v = 140 and 360.
double door(double slope, double u, double v) { return u > 200 && v > 140 ? slope * (u - 200) : 0; }

/// Cells of a surface as block matching measures it: an error of 0.13 px that is much the same over a window of 15 px.
cv::Mat1f measure(const Surface& surface, const cv::Rect& area = kArea, cv::Size image = {640, 480}) {
  cv::Mat1f noise(image);
  cv::RNG(5).fill(noise, cv::RNG::NORMAL, 0, 1);
  cv::boxFilter(noise, noise, -1, {15, 15});
  cv::Mat1f cells(image / kCell, std::numeric_limits<float>::quiet_NaN());
  for (int v = area.y; v < area.br().y; v += kCell)
    for (int u = area.x; u < area.br().x; u += kCell)
      cells(v / kCell, u / kCell) = static_cast<float>(kFixed.at(u, v) + surface(u, v) + 0.13 * 15 * noise(v, u));
  return cells;
}

std::optional<Fold> searchIn(const cv::Mat1f& cells, const cv::Rect& area, FoldSearch* search, double may_bend) {
  RegionSet set;
  for (int row = area.y / kCell; row < area.br().y / kCell; ++row) set.runs.push_back({row, area.x / kCell, area.br().x / kCell});
  set.regions.push_back({kFixed, 0, static_cast<int>(set.runs.size()), area.area() / kCell / kCell});
  return search->process(cells, set.regions[0], set, may_bend);
}

std::optional<Fold> search(const Surface& surface, FoldSearch* search, double may_bend = 0) {
  return searchIn(measure(surface), kArea, search, may_bend);
}

std::optional<Fold> search(const Surface& surface) {
  FoldSearch fresh;
  return search(surface, &fresh);
}

bool mayBeSecond(const FoldSearch& search, const Fold& fold, int u, int v) {
  return search.mayBeSecond(fold, v / kCell, u / kCell, fold.second.at(u, v));
}

TEST(FoldSearch, FindsADoorThatHasJustOpened) {
  for (const double slope : {0.005, 0.009, -0.009}) {  // 2 and 4 cm at 1.3 m
    FoldSearch folds;
    const auto fold = search([&](double u, double v) { return door(slope, u, v); }, &folds);
    ASSERT_TRUE(fold) << slope;
    // Noise with 0.13 px in each of some 100 windows: 0.013 px in the middle, three times that at the edges; three sigma.
    EXPECT_NEAR(fold->first.at(400, 250), kFixed.at(400, 250) + 200 * slope, 0.12);
    EXPECT_NEAR(fold->second.at(100, 250), kFixed.at(100, 250), 0.12);
    EXPECT_GT(fold->ahead(390, 250), 0) << "the door, not what reaches around it, is the first";
    EXPECT_LT(fold->ahead(110, 250), 0);
    EXPECT_FALSE(mayBeSecond(folds, *fold, 350, 250));
    EXPECT_TRUE(mayBeSecond(folds, *fold, 350, 100)) << "above the door";
    EXPECT_TRUE(mayBeSecond(folds, *fold, 120, 250)) << "beyond the hinge";
    EXPECT_FALSE(fold->is_step);
  }
}

TEST(FoldSearch, FlatSurfacesAreOne) {
  EXPECT_FALSE(search([](double, double) { return 0; }));
  EXPECT_FALSE(search([](double u, double) { return 0.01 * (u - 200); })) << "another plane than the region's";
}

TEST(FoldSearch, WhatACalibrationBendsIsOne) {
  // 0.15 px over the region, as the wrong calibration of real cameras has it.
  EXPECT_FALSE(search([](double u, double) { return 0.15 * std::pow((u - 250) / 150, 2); }));
}

TEST(FoldSearch, WhatADepthCameraBendsIsOne) {
  // As the flat board before a PrimeSense camera: 4 degrees about its middle column, 0.75 px at the ends.
  const auto bent = [](double slope) { return [slope](double u, double) { return slope * std::abs(u - kArea.x - 150); }; };
  FoldSearch folds;
  EXPECT_FALSE(search(bent(0.0025), &folds, kMostBend));
  EXPECT_TRUE(search(bent(0.0025), &folds, 0)) << "no pair that is calibrated does that";
  EXPECT_TRUE(search(bent(0.004), &folds, kMostBend)) << "a door";
  EXPECT_TRUE(search(bent(0.0025), &folds, 0.1)) << "of a camera whose bend is known";
}

TEST(FoldSearch, ParallelFrontsAreTwo) {
  // 2.5 and 3 cm at 2 m: the test camera has 62 px m.
  for (const double step : {0.39, 0.46, -0.46})
    for (const int edge : {180, 253, 330}) {
      FoldSearch folds;
      const auto fold = search([&](double u, double) { return u > edge ? step : 0; }, &folds);
      ASSERT_TRUE(fold) << step << " at " << edge;
      EXPECT_TRUE(fold->is_step);
      // Of 0.4 px 4 px wide, the share of a block that may be on the wrong side, and of noise as above.
      EXPECT_NEAR(fold->first.at(110, 250), kFixed.at(110, 250), 0.15);
      EXPECT_NEAR(fold->second.at(390, 250), kFixed.at(390, 250) + step, 0.15);
      const auto isFirst = [&](int u, int v) {
        const double disparity = kFixed.at(u, v) + (u > edge ? step : 0);
        EXPECT_NE(folds.mayBeFirst(*fold, v / kCell, u / kCell, disparity),
                  folds.mayBeSecond(*fold, v / kCell, u / kCell, disparity));
        return folds.mayBeFirst(*fold, v / kCell, u / kCell, disparity);
      };
      for (int v = kArea.y; v < kArea.br().y; v += 20)
        for (int u = kArea.x; u < kArea.br().x; u += 10) EXPECT_EQ(isFirst(u, v), u <= edge) << u << " " << v;
    }
}

TEST(FoldSearch, WavesTerracesAndRoundSurfacesAreNoSteps) {
  const double half = kArea.width / 2.0;
  const auto wave = [&](double height, double u) { return height * std::pow((u - kArea.x - half) / half, 3); };
  EXPECT_FALSE(search([&](double u, double) { return wave(0.15, u); })) << "a bent pair";
  FoldSearch folds;
  EXPECT_FALSE(search([&](double u, double) { return wave(0.75, u); }, &folds, kMostBend)) << "a bent camera";
  EXPECT_FALSE(search([](double u, double) { return u > 250 ? 0.125 : 0.0; })) << "the quantum of a Kinect";
  // An arm of 9 cm before a wall at 2 m, as far as the region's tolerance holds it.
  EXPECT_FALSE(search([](double u, double) { return 0.5 * std::sqrt(std::max(0.0, 1 - std::pow((u - 250) / 15, 2))); }));
}

TEST(FoldSearch, TheEndsOfABentSurfaceAreNoStep) {
  // As a depth camera of this width bends what fills its image: the ends are far apart, but not side by side.
  for (const int width : {424, 644}) {
    const cv::Rect area(0, 0, width, 240);
    const double half = width / 2.0;
    for (const double height : {0.75, 1.0}) {
      const auto wave = [&](double u, double) { return height * std::pow(u / half - 1, 3); };
      FoldSearch folds;
      EXPECT_FALSE(searchIn(measure(wave, area, area.size()), area, &folds, kMostBend)) << width << " px, " << height;
    }
  }
}

TEST(FoldSearch, SurfacesThatAreNotParallelAreNoStep) {
  // A strip that crosses the plane of its neighbour, as a region's plane cuts through what is beside a front.
  const auto fold = search([](double u, double) { return u > 340 ? 0.5 - 0.0167 * (u - 340) : 0; });
  EXPECT_FALSE(fold && fold->is_step);
}

TEST(FoldSearch, SmallRegionsAreNotLookedAt) {
  RegionSet set;
  for (int row = 100; row < 120; ++row) set.runs.push_back({row, 100, 150});
  set.regions.push_back({kFixed, 0, 20, 1000});
  FoldSearch folds;
  EXPECT_FALSE(folds.process(measure([](double u, double v) { return door(0.02, u, v); }), set.regions[0], set, true));
}

TEST(FoldSearch, NothingIsKeptFromTheLastRegion) {
  const auto ajar = [](double u, double v) { return door(0.009, u, v); };
  FoldSearch used;
  search([](double u, double v) { return door(-0.02, u, 480 - v); }, &used);
  const auto again = search(ajar, &used), fresh = search(ajar);
  ASSERT_TRUE(again && fresh);
  EXPECT_EQ(again->first.a, fresh->first.a);
  EXPECT_EQ(again->second.c, fresh->second.c);
}

}  // namespace
}  // namespace cabinet_articulation::core
