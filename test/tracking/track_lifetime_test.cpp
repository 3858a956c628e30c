// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "cabinet_articulation/tracking/rectangle_tracker.h"
#include "tracking/synthetic_fronts.h"

namespace cabinet_articulation::core {
namespace {

TEST(TrackLifetime, TwoRectanglesOfOneFrontDoNotForkItsTrack) {
  RectangleTracker tracker({});
  NoisyDetector detect(23);
  for (int i = 1; i <= 30; ++i) {
    const Rectangle door = swung(closedFront(), 0.03 * i);
    std::vector<DetectedRectangle> seen{detect.fromFront(door), detect.fromFront(door)};
    if (i % 3 == 0) seen.push_back(withHiddenEdge(detect.fromFront(door), kEdgePlusY, 0.25));
    std::rotate(seen.begin(), seen.begin() + i % seen.size(), seen.end());
    tracker.process(i * kFrame, seen);
    ASSERT_EQ(tracker.tracks().size(), 1u) << i;
  }
  EXPECT_EQ(tracker.tracks()[0].observations.size(), 30u);
}

TEST(TrackLifetime, RectanglesOfItsBackDoNotForkATrack) {
  RectangleTracker tracker({});
  NoisyDetector detect(24);
  const auto back = [&](const Rectangle& door, int i) {
    return describe(detect.plain(pulled(door, -kThickness)), kDescriptions / 2 + i % (kDescriptions / 2));
  };
  for (int i = 1; i <= 60; ++i) {
    const Rectangle door = swung(closedFront(), 0.03 * i);
    std::vector<DetectedRectangle> seen{i <= 30 ? detect.fromFront(door) : back(door, i)};
    if (i > 1) seen.push_back(back(door, i + 1));
    std::rotate(seen.begin(), seen.begin() + i % seen.size(), seen.end());
    tracker.process(i * kFrame, seen);
    ASSERT_EQ(tracker.tracks().size(), 1u) << i;
  }
  EXPECT_EQ(tracker.tracks()[0].observations.size(), 60u);
}

TEST(TrackLifetime, ClutterEndsFastAndFrontsAfterTheTimeout) {
  TrackingConfig config;
  RectangleTracker tracker(config);
  NoisyDetector detect(29);
  tracker.process(0, {detect(closedFront()), detect(closedFront(1))});
  for (int i = 1; i <= 5; ++i) tracker.process(i * kFrame, {detect(closedFront())});
  EXPECT_EQ(tracker.tracks().size(), 2u);
  EXPECT_EQ(tracker.expected().fronts.size(), 1u) << "only the confirmed one";
  tracker.process(1.5, {});
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].id, 1u);
  tracker.process(20.3, {});
  EXPECT_EQ(tracker.tracks().size(), 1u);
  tracker.process(20.4, {});
  EXPECT_TRUE(tracker.tracks().empty());
  tracker.reset();
  tracker.process(0, {detect(closedFront())});
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].id, 3u) << "an id is never used twice";
}

TEST(TrackLifetime, WhatFlickersEnds) {
  RectangleTracker tracker({});
  NoisyDetector detect(33);
  std::uint32_t newest = 0;
  for (int i = 1; i <= 90; ++i) {
    std::vector<DetectedRectangle> seen{detect(closedFront())};
    if (i % 4 == 0) seen.push_back(detect(closedFront(1, 0.3, 0.1)));
    if (i % 3 != 0) seen.push_back(detect(closedFront(2, 0.3, 0.4)));
    tracker.process(i * kFrame, seen);
    ASSERT_EQ(tracker.tracks()[0].id, 1u);
    newest = std::max(newest, tracker.tracks().back().id);
    for (const Track& track : tracker.tracks())
      EXPECT_TRUE(track.id == 1 || track.width * track.height > 0.05 || track.observations.size() <= 6) << i;
  }
  EXPECT_EQ(newest, 3u) << "the piece's short tracks have one id";
  EXPECT_EQ(std::count_if(tracker.tracks().begin(), tracker.tracks().end(),
                          [](const Track& track) { return track.observations.size() == 60; }),
            1);
}

TEST(TrackLifetime, ClutterHasOneIdAPlace) {
  RectangleTracker tracker({});
  NoisyDetector detect(34);
  const auto idOf = [&](double stamp, const Rectangle& rectangle) {
    tracker.process(stamp, {detect(rectangle)});
    return tracker.tracks().back().id;
  };
  const std::uint32_t piece = idOf(1, closedFront(0, 0.3, 0.4));
  EXPECT_EQ(idOf(3, closedFront(0.05, 0.3, 0.2)), piece) << "of another size, after the track ended";
  EXPECT_EQ(tracker.tracks().back().observations.size(), 1u) << "a new track";
  EXPECT_GT(tracker.tracks().back().revision, 0u) << "which nobody takes for the old one";
  EXPECT_NE(idOf(5, closedFront(0.35, 0.3, 0.4)), piece) << "beside it";
  EXPECT_NE(idOf(7, pulled(closedFront(0.05, 0.3, 0.2), 0.2)), piece) << "before it";
  ASSERT_TRUE(tracker.forget(piece));
  EXPECT_NE(idOf(9, closedFront(0.05, 0.3, 0.2)), piece) << "forgotten";
}

TEST(TrackLifetime, AnotherSizeInThePlaceOfAMissedGlimpseHasItsId) {
  RectangleTracker tracker({});
  NoisyDetector detect(35);
  const Rectangle front = closedFront(0, 0.3, 0.4), part = closedFront(0.05, 0.2, 0.2);
  tracker.process(1 * kFrame, {detect(part)});
  tracker.process(2 * kFrame, {detect(front)});
  EXPECT_EQ(tracker.tracks().size(), 2u) << "the first one was missed once only";
  tracker.process(3 * kFrame, {detect(front)});
  tracker.process(4 * kFrame, {detect(front)});
  tracker.process(5 * kFrame, {detect(closedFront(0.02, 0.25, 0.25))});
  ASSERT_EQ(tracker.tracks().size(), 2u);
  EXPECT_EQ(tracker.tracks().front().id, 1u);
  EXPECT_EQ(tracker.tracks().front().observations.back().stamp, 5 * kFrame) << "of the id's new track";
  EXPECT_EQ(tracker.tracks().back().observations.size(), 3u) << "what is confirmed goes on";
}

TEST(TrackLifetime, AFrontThatIsMissedNowAndThenKeepsItsId) {
  int kept = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    RectangleTracker tracker({});
    NoisyDetector detect(seed);
    std::mt19937 random(seed);
    for (int i = 1; i <= 60; ++i) {
      const bool missed = i > 1 && std::uniform_real_distribution<double>()(random) < 0.3;
      tracker.process(i * kFrame,
                      missed ? std::vector<DetectedRectangle>() : std::vector<DetectedRectangle>{detect(closedFront())});
    }
    kept += tracker.tracks().size() == 1 && tracker.tracks()[0].id == 1;
  }
  EXPECT_GE(kept, 95) << "of 100; to see three of the first eight frames only happens to one in a hundred";
}

TEST(TrackLifetime, AHandInFrontOfAYoungTrackIsNoFlicker) {
  for (int hidden : {5, 20, 200}) {
    RectangleTracker tracker({});
    NoisyDetector detect(35);
    for (int i = 1; i <= 30 + 2 * hidden; ++i) {
      const bool seen = i <= 5 || (i > 5 + hidden && i <= 8 + hidden) || i > 8 + 2 * hidden;
      tracker.process(i * kFrame,
                      seen ? std::vector<DetectedRectangle>{detect(closedFront())} : std::vector<DetectedRectangle>());
    }
    ASSERT_EQ(tracker.tracks().size(), 1u) << hidden;
    EXPECT_EQ(tracker.tracks()[0].id, 1u) << hidden;
  }
}

TEST(TrackLifetime, ProposesOnlySizesThatWereObserved) {
  RectangleTracker tracker({});
  NoisyDetector detect(30);
  const auto merged = [&](const Rectangle& front) { return withHiddenEdge(detect.plain(front), kEdgePlusX, -0.3); };
  for (int i = 1; i <= 10; ++i) tracker.process(i * kFrame, {merged(closedFront()), detect(closedFront(2))});
  EXPECT_EQ(tracker.tracks().size(), 2u);
  ASSERT_EQ(tracker.expected().fronts.size(), 1u);
  EXPECT_NEAR(tracker.expected().fronts[0].rectangle.center().x(), 2, 0.01);
  EXPECT_NEAR(tracker.expected().fronts[0].rectangle.width * tracker.expected().fronts[0].rectangle.height, 0.395 * 0.58, 0.005);
  tracker.process(2, {});
  EXPECT_TRUE(tracker.expected().fronts.empty()) << "lost";
}

TEST(TrackLifetime, AJumpOfAMetreIsAnotherFront) {
  RectangleTracker tracker({});
  NoisyDetector detect(31);
  for (int i = 1; i <= 10; ++i) tracker.process(i * kFrame, {detect(closedFront(i == 6 ? 1 : 0))});
  ASSERT_EQ(tracker.tracks().size(), 2u);
  EXPECT_EQ(tracker.tracks()[0].observations.size(), 9u);
}

TEST(TrackLifetime, FlickeringClutterDoesNotDisturbAFront) {
  const auto drawer = [](double t) { return pulled(closedFront(0, 0.395, 0.125), 0.3 * opening(t, 4)); };
  NoisyDetector detect(37);
  RectangleTracker tracker({});
  for (int i = 1; i <= 60; ++i) {
    std::vector<DetectedRectangle> seen;
    for (int k = 0; k < 6; ++k) {
      Rectangle clutter = closedFront(detect.noise(0.5), 0.2 + std::abs(detect.noise(0.3)), 0.1 + std::abs(detect.noise(0.3)));
      clutter.pose.translation() += Eigen::Vector3d(0, detect.noise(0.3), 0.2 + std::abs(detect.noise(0.3)));
      clutter.pose.rotate(Eigen::AngleAxisd(detect.noise(0.5), Eigen::Vector3d::UnitX()));
      seen.push_back(detect(clutter));
    }
    seen.push_back(detect.fromFront(drawer(i * kFrame)));
    tracker.process(i * kFrame, seen);
  }
  const auto longest = std::max_element(tracker.tracks().begin(), tracker.tracks().end(), [](const Track& a, const Track& b) {
    return a.observations.size() < b.observations.size();
  });
  EXPECT_GE(longest->observations.size(), 58u);
  EXPECT_LT(largestError(*longest, drawer), 0.02);
}

TEST(TrackLifetime, APartOfAMovingFrontIsNoOther) {
  RectangleTracker tracker({});
  NoisyDetector detect(24);
  for (int i = 1; i <= 30; ++i) {
    const Rectangle drawer = pulled(closedFront(0, 0.395, 0.125), 0.01 * i);
    Rectangle half = drawer;
    half.pose.translate(Eigen::Vector3d(0.1, 0, 0));
    half.width = 0.17;
    // Now and then a hand leaves only half of it.
    tracker.process(i * kFrame, {detect.fromFront(i % 7 == 6 ? half : drawer)});
    ASSERT_EQ(tracker.tracks().size(), 1u) << i;
  }
}

TEST(TrackLifetime, AFrontInTheFaceOfAnotherHasItsOwnTrack) {
  RectangleTracker tracker({});
  NoisyDetector detect(25);
  for (int i = 1; i <= 10; ++i)
    tracker.process(i * kFrame, {detect.fromFront(closedFront(0, 0.6, 0.58)), detect.fromFront(closedFront(0.1, 0.3, 0.15))});
  EXPECT_EQ(tracker.tracks().size(), 2u);
}

}  // namespace
}  // namespace cabinet_articulation::core
