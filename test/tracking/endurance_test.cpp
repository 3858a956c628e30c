// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <set>

#include "cabinet_articulation/tracking/rectangle_tracker.h"
#include "tracking/synthetic_fronts.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kFrame = 1.0 / 15;
constexpr int kFrames = 100000;  ///< almost two hours

Rectangle drawer() { return closedFront(0, 0.395, 0.125); }

/// A drawer that is used every half minute, stands open for a while, and is not seen while it is closed; a front that
/// stands still; and a piece of clutter now here, now there, for a few frames or for seconds.
class BusyKitchen {
 public:
  static double opening(double t) {
    const double phase = std::fmod(t, 30);
    return phase < 12 ? 0.3 * std::min(1.0, 2 * (0.5 - 0.5 * std::cos(2 * M_PI * phase / 12))) : 0;
  }

  std::vector<DetectedRectangle> frame(int i) {
    std::vector<DetectedRectangle> seen{detect_.fromFront(closedFront(1))};
    const double q = opening(i * kFrame);
    if (q > 0.03) seen.push_back(detect_.fromFront(pulled(drawer(), q)));
    if (i % 45 == 0) clutter_ = closedFront(-2 + detect_.noise(0.3), 0.2 + std::abs(detect_.noise(0.2)), 0.3);
    if (i % 45 < 5 + i % 40) seen.push_back(detect_.fromFront(clutter_));
    return seen;
  }

 private:
  NoisyDetector detect_{1};
  Rectangle clutter_ = closedFront(-2);
};

TEST(Endurance, HoursOfVideoCostNoMoreThanMinutes) {
  TrackingConfig config;
  config.max_observations = 200;
  RectangleTracker tracker(config);
  BusyKitchen kitchen;
  std::set<std::uint32_t> drawer_ids;
  std::size_t most_tracks = 0, most_observations = 0;
  std::vector<double> seconds;  // of the processor, for a hundredth of the video each
  for (int i = 0; i < kFrames; ++i) {
    const auto rectangles = kitchen.frame(i);
    const std::clock_t start = std::clock();
    const std::vector<Track>& tracks = tracker.process(i * kFrame, rectangles);
    if (i % (kFrames / 100) == 0) seconds.push_back(0);
    seconds.back() += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    most_tracks = std::max(most_tracks, tracks.size());
    const double q = BusyKitchen::opening(i * kFrame);
    for (const Track& track : tracks) {
      most_observations = std::max(most_observations, track.observations.size());
      const TrackedObservation& newest = track.observations.back();
      if (newest.stamp == i * kFrame && (newest.rectangle.center() - pulled(drawer(), q).center()).norm() < 0.03)
        drawer_ids.insert(track.id);
    }
  }
  EXPECT_EQ(drawer_ids.size(), 1u) << "the drawer was used two hundred times";
  EXPECT_LE(most_observations, 200u);
  EXPECT_LE(most_tracks, 20u);
  const auto quarter = seconds.size() / 4;
  const double early = *std::min_element(seconds.begin() + 1, seconds.begin() + quarter);
  const double late = *std::min_element(seconds.end() - quarter, seconds.end());
  EXPECT_LT(late, 2 * early) << "the least of 25 is hardly disturbed by other programs";
}

TEST(Endurance, WhatMovedOnceIsKnownForHours) {
  TrackingConfig config;
  config.max_observations = 64;
  RectangleTracker tracker(config);
  NoisyDetector detect(47);
  const auto opening = [](double t) { return pulled(drawer(), t < 2 ? 0.15 - 0.15 * std::cos(M_PI * t / 2) : 0.3); };
  for (int i = 1; i <= 3000; ++i) tracker.process(i * kFrame, {detect(opening(i * kFrame))});
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_LE(tracker.tracks()[0].observations.size(), 64u);
  double least = 1;
  for (const TrackedObservation& observation : tracker.tracks()[0].observations)
    least = std::min(least, (observation.rectangle.center() - drawer().center()).norm());
  EXPECT_LT(least, 0.1) << "the opening is still in the history";
}

}  // namespace
}  // namespace cabinet_articulation::core
