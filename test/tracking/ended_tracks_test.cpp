// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracker/ended_tracks.h"

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

TEST_F(LostDrawer, IsForgottenAlone) {
  EXPECT_FALSE(tracker_.forget(99));
  EXPECT_TRUE(tracker_.forget(1));
  EXPECT_FALSE(tracker_.forget(1));
  expectNew(drawer());
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
    EXPECT_EQ(taken[id]->first.revision, 0u) << "those that are left did not change";
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
