// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/ended_tracks.h"

#include <gtest/gtest.h>

#include "cabinet_articulation/tracking/rectangle_tracker.h"
#include "tracking/synthetic_fronts.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kFrame = 1.0 / 15;
constexpr double kLong = 3600;  ///< [s] far beyond any timeout

Rectangle drawer(double x = 0) { return closedFront(x, 0.395, 0.125); }

/// A tracker that has seen a drawer come out by 20 cm and go back, and has lost it since.
class LostDrawer : public testing::Test {
 protected:
  void SetUp() override {
    for (int i = 0; i <= 20; ++i) tracker_.process(i * kFrame, {detect_.fromFront(pulled(drawer(), 0.2 * i / 20))});
    for (int i = 21; i <= 40; ++i) tracker_.process(i * kFrame, {detect_.fromFront(pulled(drawer(), 0.2 * (40 - i) / 20))});
    tracker_.process(kLong, {});
    ASSERT_TRUE(tracker_.tracks().empty());
  }

  void expectBack(const Rectangle& front) {
    tracker_.process(kLong + kFrame, {detect_(front)});
    ASSERT_EQ(tracker_.tracks().size(), 1u);
    EXPECT_EQ(tracker_.tracks()[0].id, 1u);
    EXPECT_EQ(tracker_.tracks()[0].observations.size(), 42u) << "its history is back, too";
    EXPECT_LT(cornerError(tracker_.tracks()[0].observations.back().rectangle, front), 0.02);
  }

  void expectNew(const Rectangle& front) {
    tracker_.process(kLong + kFrame, {detect_.fromFront(front)});
    ASSERT_EQ(tracker_.tracks().size(), 1u);
    EXPECT_EQ(tracker_.tracks()[0].id, 2u);
    EXPECT_EQ(tracker_.tracks()[0].observations.size(), 1u);
  }

  static double cornerError(const Rectangle& rectangle, const Rectangle& truth) {
    return (alignDescription(rectangle, truth, true).center() - truth.center()).norm();
  }

  RectangleTracker tracker_{TrackingConfig()};
  NoisyDetector detect_{1};
};

TEST_F(LostDrawer, ComesBackClosed) { expectBack(drawer()); }
TEST_F(LostDrawer, ComesBackHalfOpen) { expectBack(pulled(drawer(), 0.1)); }
TEST_F(LostDrawer, ComesBackFartherOutThanEverSeen) { expectBack(pulled(drawer(), 0.35)); }
TEST_F(LostDrawer, ItsNeighbourIsAnotherDrawer) { expectNew(pulled(drawer(0.395), 0.1)); }
TEST_F(LostDrawer, AFrontOfAnotherSizeIsAnotherFront) { expectNew(closedFront(0, 0.395, 0.18)); }
TEST_F(LostDrawer, NoDrawerGoesIntoItsCabinet) { expectNew(pulled(drawer(), -0.1)); }

TEST_F(LostDrawer, ComesBackAfterAFirstGlimpseThatWasTooBadToRecogniseIt) {
  // Barely open, its lower edge cannot be told from the neighbour's.
  Rectangle glimpse = pulled(drawer(), 0.01);
  glimpse.height += 0.036;
  glimpse.pose.translation() += 0.018 * Eigen::Vector3d::UnitY();
  expectNew(glimpse);
  for (int i = 2; i <= 4; ++i) tracker_.process(kLong + i * kFrame, {detect_(pulled(drawer(), 0.01 * i))});
  ASSERT_EQ(tracker_.tracks().size(), 1u);
  EXPECT_EQ(tracker_.tracks()[0].id, 1u);
  EXPECT_EQ(tracker_.tracks()[0].observations.size(), 44u) << "all but the glimpse";
}

TEST_F(LostDrawer, OnlyOneRectangleGetsTheId) {
  const auto back = detect_(pulled(drawer(), 0.05));
  const auto neighbour = detect_.fromFront(pulled(drawer(0.395), 0.05));
  tracker_.process(kLong + kFrame, {neighbour, back});
  ASSERT_EQ(tracker_.tracks().size(), 2u);
  EXPECT_EQ(tracker_.tracks()[0].id, 1u);
  EXPECT_LT(cornerError(tracker_.tracks()[0].observations.back().rectangle, pulled(drawer(), 0.05)), 0.02);
  EXPECT_EQ(tracker_.tracks()[1].id, 2u);
}

TEST_F(LostDrawer, MayBeLostAgain) {
  for (int lost = 1; lost <= 5; ++lost) {
    for (int i = 0; i < 3; ++i) tracker_.process(kLong * (1 + lost) + i * kFrame, {detect_(pulled(drawer(), 0.05 * lost))});
    ASSERT_EQ(tracker_.tracks().size(), 1u);
    EXPECT_EQ(tracker_.tracks()[0].id, 1u);
    tracker_.process(kLong * (1.5 + lost), {});
  }
}

TEST_F(LostDrawer, ResetForgetsItForGood) {
  tracker_.reset();
  expectNew(drawer());
}

TEST(EndedTracks, FrontsOfAnEarlierRunAreKnownWhateverItsClockSaid) {
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

TEST(EndedTracks, FrontsThatReturnAtTimeZeroAreKnown) {
  NoisyDetector detect(1);
  RectangleTracker yesterday{TrackingConfig()}, today{TrackingConfig()};
  for (int i = 0; i <= 20; ++i) yesterday.process(100 + i * kFrame, {detect.fromFront(pulled(drawer(), 0.2 * i / 20))});
  today.remember(yesterday.tracks());
  today.process(0, {detect(pulled(drawer(), 0.1))});
  ASSERT_EQ(today.tracks().size(), 1u);
  EXPECT_EQ(today.tracks()[0].observations.size(), 22u);
  for (const TrackedObservation& observation : today.tracks()[0].observations) EXPECT_EQ(observation.stamp, 0);
}

TEST(EndedTracks, HistoriesThatWouldNotBeOverArePutBeforeNow) {
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

TEST(EndedTracks, IdsOfKnownFrontsAreNotGivenAgainAndOthersAreRefused) {
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

TEST_F(LostDrawer, IsForgottenAlone) {
  EXPECT_FALSE(tracker_.forget(99));
  EXPECT_TRUE(tracker_.forget(1));
  EXPECT_FALSE(tracker_.forget(1));
  expectNew(drawer());
}

TEST(RectangleTracker, ForgetsALiveTrackWhileTheOthersGoOn) {
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

TEST(RectangleTracker, HandsOnAllItsFrontsToAnother) {
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

TEST(EndedTracks, ADoorComesBackAtAnyAngle) {
  for (double q : {0.0, 0.4, 1.0, 1.6}) {
    NoisyDetector detect(2);
    RectangleTracker tracker({});
    for (int i = 0; i <= 20; ++i) tracker.process(i * kFrame, {detect.fromFront(swung(closedFront(), 0.05 * i))});
    tracker.process(kLong, {});
    tracker.process(kLong + kFrame, {detect(swung(closedFront(), q))});
    ASSERT_EQ(tracker.tracks().size(), 1u) << q;
    EXPECT_EQ(tracker.tracks()[0].id, 1u) << q;
  }
}

Track trackOf(std::uint32_t id, double x, double pull, int observations) {
  NoisyDetector detect(id);
  Track track;
  track.id = id;
  for (int i = 0; i < observations; ++i) {
    const DetectedRectangle seen = detect.plain(pulled(drawer(x), pull * i / (observations - 1)));
    track.observations.push_back(
        {i * kFrame, seen.rectangle, seen.covariance, seen.edge_support, seen.rectangle, seen.covariance});
  }
  return track;
}

TrackMemory memoryOf(const Track& track, const TrackingConfig& config) {
  TrackMemory memory{FrontSize(config)};
  for (const TrackedObservation& observation : track.observations) {
    DetectedRectangle seen;
    seen.rectangle = observation.measured;
    seen.edge_support = observation.edge_support;
    memory.size.add(seen);
  }
  return memory;
}

TEST(EndedTracks, ForgetsThoseThatMovedLeastAndThinsTheRest) {
  TrackingConfig config;
  config.max_ended_tracks = 3;
  EndedTracks ended(config);
  const double pulls[] = {0.01, 0.3, 0.0, 0.2, 0.02, 0.25};
  for (std::uint32_t id = 0; id < 6; ++id) {
    Track track = trackOf(id, id, pulls[id], 500);
    TrackMemory memory = memoryOf(track, config);
    ended.keep(std::move(track), std::move(memory));
  }
  NoisyDetector detect(7);
  std::vector<DetectedRectangle> seen;
  for (std::uint32_t id = 0; id < 6; ++id) seen.push_back(detect(drawer(id)));
  const auto taken = ended.takeBack(seen, kLong);
  ASSERT_EQ(taken.size(), 6u);
  for (std::uint32_t id = 0; id < 6; ++id) {
    ASSERT_EQ(taken[id].has_value(), pulls[id] > 0.1) << id;
    if (!taken[id]) continue;
    EXPECT_EQ(taken[id]->first.id, id);
    EXPECT_LE(taken[id]->first.observations.size(), 64u);
    EXPECT_GT(taken[id]->first.revision, 0u) << "earlier observations changed";
  }
  for (const auto& again : ended.takeBack(seen, kLong)) EXPECT_FALSE(again) << "taken only once";
}

TEST(EndedTracks, MayKeepNone) {
  TrackingConfig config;
  config.max_ended_tracks = 0;
  EndedTracks ended(config);
  Track track = trackOf(0, 0, 0.3, 10);
  TrackMemory memory = memoryOf(track, config);
  ended.keep(std::move(track), std::move(memory));
  NoisyDetector detect(7);
  EXPECT_FALSE(ended.takeBack({detect(drawer())}, kLong)[0]);
}

}  // namespace
}  // namespace cabinet_articulation::core
