// SPDX-License-Identifier: BSD-3-Clause
// Fronts of an earlier run or of another tracker, whose clocks may have been others, and fronts that are forgotten.
#include <gtest/gtest.h>

#include "cabinet_articulation/tracking/rectangle_tracker.h"
#include "tracking/synthetic_fronts.h"
#include "tracking/tracker/ended_tracks.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kFrame = 1.0 / 15;
constexpr double kLong = 3600;  ///< [s] far beyond any timeout

Rectangle drawer(double x = 0) { return closedFront(x, 0.395, 0.125); }

TEST(RememberedFronts, FrontsOfAnEarlierRunAreKnownWhateverItsClockSaid) {
  NoisyDetector detect(1);
  RectangleTracker yesterday{TrackingConfig()};
  yesterday.process(99, {detect.fromFront(closedFront(1.5, 0.5, 0.5))});
  for (int i = 0; i <= 20; ++i)
    yesterday.process(100 + i * kFrame,
                      {detect.fromFront(pulled(drawer(), 0.2 * i / 20)), detect.fromFront(closedFront(1.5, 0.5, 0.5))});
  ASSERT_EQ(yesterday.tracks().size(), 2u);
  for (const double now : {0.01, 5.0, 101.0, 1e6}) {
    RectangleTracker today{TrackingConfig()};
    today.remember(yesterday.tracks());
    EXPECT_TRUE(today.tracks().empty()) << "not seen yet";
    today.process(now, {detect.fromFront(closedFront(-1.5, 0.3, 0.3)), detect(pulled(drawer(), 0.1))});
    ASSERT_EQ(today.tracks().size(), 2u);
    EXPECT_EQ(today.tracks()[0].id, 2u) << "its old id";
    EXPECT_EQ(today.tracks()[0].observations.size(), 22u) << "its old history";
    EXPECT_EQ(today.tracks()[1].id, 3u) << "a new front gets none of the old ids";
    for (size_t i = 1; i < 22; ++i)
      EXPECT_GT(today.tracks()[0].observations[i].stamp, today.tracks()[0].observations[i - 1].stamp);
    EXPECT_GE(today.tracks()[0].observations[0].stamp, 0) << "no message holds a time before that";
    EXPECT_EQ(today.tracks()[0].observations.back().stamp, now);
    if (now < 1000) continue;
    EXPECT_EQ(today.tracks()[0].observations[20].stamp, yesterday.tracks()[1].observations[20].stamp) << "as it was";
  }
}

TEST(RememberedFronts, FrontsThatReturnAtTimeZeroAreKnown) {
  NoisyDetector detect(1);
  RectangleTracker yesterday{TrackingConfig()}, today{TrackingConfig()};
  for (int i = 0; i <= 20; ++i) yesterday.process(100 + i * kFrame, {detect.fromFront(pulled(drawer(), 0.2 * i / 20))});
  today.remember(yesterday.tracks());
  today.process(0, {detect(pulled(drawer(), 0.1))});
  ASSERT_EQ(today.tracks().size(), 1u);
  EXPECT_EQ(today.tracks()[0].observations.size(), 22u);
  for (const TrackedObservation& observation : today.tracks()[0].observations) EXPECT_EQ(observation.stamp, 0);
}

TEST(RememberedFronts, HistoriesThatWouldNotBeOverArePutBeforeNow) {
  const auto stampsAt = [](std::vector<double> stamps, double now) {
    std::vector<TrackedObservation> history(stamps.size());
    for (size_t i = 0; i < stamps.size(); ++i) history[i].stamp = stamps[i];
    placeBefore(history, now, 20);
    for (size_t i = 0; i < stamps.size(); ++i) stamps[i] = history[i].stamp;
    return stamps;
  };
  EXPECT_EQ(stampsAt({100, 104, 106}, 80), (std::vector<double>{54, 58, 60})) << "as long as it was";
  EXPECT_EQ(stampsAt({100, 104, 106}, 30), (std::vector<double>{9, 13, 15})) << "half-way";
  EXPECT_EQ(stampsAt({100, 104, 106}, 6), (std::vector<double>{0, 2, 3})) << "compressed";
  EXPECT_EQ(stampsAt({100}, 6), (std::vector<double>{3}));
}

TEST(RememberedFronts, IdsOfKnownFrontsAreNotGivenAgainAndOthersAreRefused) {
  NoisyDetector detect(1);
  RectangleTracker tracker{TrackingConfig()};
  const auto knownAt = [&](std::uint32_t id, double x) {
    RectangleTracker other{TrackingConfig()};
    for (int i = 0; i < 5; ++i) other.process(i * kFrame, {detect.fromFront(closedFront(x))});
    Track track = other.tracks().at(0);
    track.id = id;
    return track;
  };
  tracker.remember({knownAt(0, 0), knownAt(4294967295U, 1), knownAt(7, 2)});
  EXPECT_EQ(tracker.nextId(), 8u);
  tracker.remember({knownAt(7, 5)});
  EXPECT_EQ(tracker.knownTracks().size(), 1u) << "known already";
  tracker.useIdsFrom(4294967295U);
  for (int i = 0; i < 3; ++i)
    tracker.process(1 + i * kFrame, {detect.fromFront(closedFront(-2)), detect.fromFront(closedFront(-4))});
  ASSERT_EQ(tracker.tracks().size(), 2u);
  EXPECT_EQ(tracker.tracks()[0].id, 1u) << "0 is nobody";
  EXPECT_EQ(tracker.tracks()[1].id, 4294967295U);
}

TEST(Forgetting, EndsALiveTrackWhileTheOthersGoOn) {
  NoisyDetector detect(3);
  RectangleTracker tracker{TrackingConfig()};
  const auto see = [&](int i) { tracker.process(i * kFrame, {detect.fromFront(drawer()), detect.fromFront(drawer(1))}); };
  for (int i = 1; i <= 10; ++i) see(i);
  ASSERT_EQ(tracker.tracks().size(), 2u);
  const std::uint32_t gone = tracker.tracks()[0].id, stays = tracker.tracks()[1].id;
  EXPECT_TRUE(tracker.forget(gone));
  for (int i = 11; i <= 20; ++i) see(i);
  ASSERT_EQ(tracker.tracks().size(), 2u);
  EXPECT_EQ(tracker.tracks()[0].id, stays);
  EXPECT_EQ(tracker.tracks()[0].observations.size(), 20u) << "without interruption";
  EXPECT_EQ(tracker.tracks()[1].id, 3u) << "seen again, it is another";
  EXPECT_EQ(tracker.tracks()[1].observations.size(), 10u);
}

TEST(RememberedFronts, AreHandedOnToAnotherTracker) {
  NoisyDetector detect(3);
  RectangleTracker tracker{TrackingConfig()}, other{TrackingConfig()};
  for (int i = 1; i <= 10; ++i) tracker.process(i * kFrame, {detect.fromFront(pulled(drawer(), 0.01 * i))});
  tracker.process(kLong, {detect.fromFront(closedFront(2))});
  other.remember(tracker.knownTracks());
  other.useIdsFrom(tracker.nextId());
  other.process(kLong + kFrame, {detect.fromFront(closedFront(2)), detect.fromFront(drawer()), detect.fromFront(closedFront(5))});
  ASSERT_EQ(other.tracks().size(), 3u);
  for (std::uint32_t id = 1; id <= 3; ++id) EXPECT_EQ(other.tracks()[id - 1].id, id);
}

}  // namespace
}  // namespace cabinet_articulation::core
