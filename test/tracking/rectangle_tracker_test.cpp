// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/rectangle_tracker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tracking/motion/motion_gate.h"
#include "tracking/synthetic_fronts.h"

namespace cabinet_articulation::core {
namespace {

TEST(RectangleTracker, ADoorNeverFlipsUpTo100DegreesWhateverItsDescriptions) {
  const auto door = [](double t) { return swung(closedFront(), 1.75 * opening(t, 4)); };
  for (unsigned seed = 1; seed <= 5; ++seed) {
    NoisyDetector detect(seed);
    RectangleTracker tracker({});
    tracker.process(kFrame, {detect.fromFront(door(kFrame))});
    for (int i = 2; i <= 120; ++i) tracker.process(i * kFrame, {detect(door(i * kFrame))});
    ASSERT_EQ(tracker.tracks().size(), 1u) << seed;
    const Track& track = tracker.tracks()[0];
    EXPECT_EQ(track.observations.size(), 120u);
    EXPECT_LT(largestError(track, door), 0.02) << "four sigma of the detector, all channels together";
    EXPECT_NEAR(std::min(track.width, track.height), 0.395, 0.002) << "4 mm / sqrt(120), and the median's loss";
    EXPECT_NEAR(std::max(track.width, track.height), 0.58, 0.002);
  }
}

TEST(RectangleTracker, TheBackOfADoorIsABoardBehindItsFront) {
  const auto door = [](int i) { return swung(closedFront(), 0.05 * i); };
  for (const double thickness : {0.016, 0.018, 0.022}) {
    NoisyDetector detect(1);
    RectangleTracker tracker({});
    for (int i = 0; i < 32; ++i) tracker.process((i + 1) * kFrame, {detect.fromFront(door(i))});
    const auto across = [&tracker] {
      const TrackedObservation& newest = tracker.tracks()[0].observations.back();
      const Eigen::Vector3d normal = newest.rectangle.normal();
      return std::sqrt(normal.dot(newest.covariance.topLeftCorner<3, 3>() * normal));
    };
    EXPECT_LT(across(), 0.005) << "seen from the front";
    double off = 0;
    for (int i = 32; i < 40; ++i) {
      tracker.process((i + 1) * kFrame, {describe(detect.plain(pulled(door(i), -thickness)), 4)});
      ASSERT_EQ(tracker.tracks().size(), 1u) << thickness;
      const Rectangle& seen = tracker.tracks()[0].observations.back().rectangle;
      off += std::abs(door(i).plane().distance(seen.center())) / 8;
    }
    EXPECT_LT(off, 0.005) << "the detector's noise and 4 mm; the thickness, if the back were taken for the front: " << thickness;
    EXPECT_GT(across(), 0.005) << "nobody knows how thick it is";
    EXPECT_LT(off, across()) << thickness;
  }
}

TEST(RectangleTracker, ASquareDoorDoesNotFlipEither) {
  const auto door = [](double t) { return swung(closedFront(0, 0.4, 0.4), 1.75 * opening(t, 4)); };
  NoisyDetector detect(3);
  RectangleTracker tracker({});
  for (int i = 1; i <= 60; ++i) tracker.process(i * kFrame, {detect(door(i * kFrame))});
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_LT(largestError(tracker.tracks()[0], door), 0.02);
}

TEST(RectangleTracker, ADrawerKeepsItsIdThroughGapsAndAFastReclosing) {
  // Pulled out 35 cm in half a second and pushed back, seen only now and then, with gaps of a second.
  const auto drawer = [](double t) { return pulled(closedFront(0, 0.395, 0.125), 0.35 * opening(t, 1)); };
  NoisyDetector detect(7);
  RectangleTracker tracker({});
  for (int i = 1; i <= 150; ++i) {
    const bool hidden = (i % 40) < 15 || i % 3 == 0;
    tracker.process(i * kFrame, hidden ? std::vector<DetectedRectangle>{}
                                       : std::vector<DetectedRectangle>{detect.fromFront(drawer(i * kFrame))});
  }
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].id, 1u);
  EXPECT_LT(largestError(tracker.tracks()[0], drawer), 0.02);
}

TEST(RectangleTracker, ADoorSwungOpenBehindAHandIsTheSameDoor) {
  NoisyDetector detect(8);
  RectangleTracker tracker({});
  for (int i = 1; i <= 5; ++i) tracker.process(i * kFrame, {detect.fromFront(swung(closedFront(), 0.02 * i))});
  tracker.process(5 * kFrame + 1, {detect.fromFront(swung(closedFront(), 1.4))});
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].observations.size(), 6u);
}

TEST(RectangleTracker, TheBodysFrameBehindADoorIsAnotherFront) {
  NoisyDetector detect(10);
  RectangleTracker tracker({});
  DetectedRectangle body = detect.fromFront(closedFront());
  body.hollow = true;
  for (int i = 1; i <= 5; ++i) tracker.process(i * kFrame, {detect.fromFront(closedFront())});
  tracker.process(6 * kFrame, {body});
  ASSERT_EQ(tracker.tracks().size(), 2u);
  EXPECT_FALSE(tracker.tracks()[0].hollow);
  EXPECT_EQ(tracker.tracks()[0].observations.size(), 5u);
  EXPECT_TRUE(tracker.tracks()[1].hollow);
}

TEST(RectangleTracker, AGlassDoorStaysTheSameWhereItsPaneIsNotSeen) {
  NoisyDetector detect(11);
  RectangleTracker tracker({});
  for (int i = 1; i <= 10; ++i) {
    DetectedRectangle door = detect.fromFront(swung(closedFront(), 0.05 * i));
    door.hollow = i < 6 || i == 9;
    tracker.process(i * kFrame, {door});
  }
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].observations.size(), 10u);
  EXPECT_TRUE(tracker.tracks()[0].hollow);
}

TEST(RectangleTracker, ADoorThatClosedBehindAHandGoesBackAlongItsHistory) {
  NoisyDetector detect(9);
  RectangleTracker tracker({});
  for (int i = 1; i <= 30; ++i) tracker.process(i * kFrame, {detect.fromFront(swung(closedFront(), 0.05 * i))});
  tracker.process(4, {detect.fromFront(swung(closedFront(), 0.1))});
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].observations.size(), 31u);
}

TEST(RectangleTracker, ADoorSwungBeyond90DegreesUnseenIsNotItsOwnBack) {
  NoisyDetector detect(10);
  for (double q : {1.4, 1.5, 1.6, 1.7}) {
    RectangleTracker tracker({});
    for (int i = 1; i <= 5; ++i) tracker.process(i * kFrame, {detect.fromFront(closedFront())});
    tracker.process(5 * kFrame + 1, {detect.fromFront(swung(closedFront(), q))});
    ASSERT_EQ(tracker.tracks().size(), 1u) << q;
    const auto truth = [&](double t) { return swung(closedFront(), t > 1 ? q : 0); };
    EXPECT_LT(largestError(tracker.tracks()[0], truth), 0.02) << q;
  }
}

TEST(RectangleTracker, NeighboursOfEqualSizeKeepTheirIds) {
  // Two doors side by side; one moves, then the other, each invisible while closed.
  const double width = closedFront().width;
  NoisyDetector detect(11);
  RectangleTracker tracker({});
  std::vector<std::uint32_t> ids[2];
  for (int i = 1; i <= 300; ++i) {
    const double t = i * kFrame;
    const double q[] = {1.5 * opening(std::fmod(t, 10), 5) * (std::fmod(t, 10) < 5),
                        1.5 * opening(std::fmod(t, 10) - 5, 5) * (std::fmod(t, 10) > 5)};
    std::vector<DetectedRectangle> seen;
    for (int k = 0; k < 2; ++k)
      if (q[k] > 0.08) seen.push_back(detect.fromFront(swung(closedFront(k * width), q[k])));
    tracker.process(t, seen);
    for (int k = 0; k < 2; ++k)
      for (const Track& track : tracker.tracks())
        if (q[k] > 0.08 &&
            cornerDistance(alignDescription(track.observations.back().rectangle, swung(closedFront(k * width), q[k]), true),
                           swung(closedFront(k * width), q[k])) < 0.03 &&
            track.observations.back().stamp == t)
          ids[k].push_back(track.id);
  }
  for (int k = 0; k < 2; ++k) {
    ASSERT_GT(ids[k].size(), 100u);
    EXPECT_EQ(*std::min_element(ids[k].begin(), ids[k].end()), *std::max_element(ids[k].begin(), ids[k].end())) << k;
  }
  EXPECT_NE(ids[0][0], ids[1][0]);
  EXPECT_EQ(tracker.tracks().size(), 2u);
}

TEST(RectangleTracker, AnOccluderAcrossAnEdgeIsNoMotion) {
  const Rectangle front = closedFront();
  NoisyDetector detect(13);
  RectangleTracker tracker({});
  for (int i = 1; i <= 60; ++i) {
    DetectedRectangle detection = detect.plain(front);
    // A hand goes over the lower edge and hides up to half of the front; near its way the right edge slides, too.
    if (i > 15 && i < 45) detection = withHiddenEdge(detection, kEdgeMinusY, 0.3 * opening(i - 15, 30));
    if (i > 20 && i < 30) detection = withHiddenEdge(detection, kEdgePlusX, -0.1);
    tracker.process(i * kFrame, {describe(detection, i % 4)});
  }
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].observations.size(), 59u + 1);
  EXPECT_LT(largestError(tracker.tracks()[0], [&](double) { return front; }), 0.02);
}

TEST(RectangleTracker, AnOpeningDoorThatLooksTooWideIsPlacedAnew) {
  // While hardly open the hinge edge is not seen and the door appears up to 12 cm wider.
  const auto door = [](double t) { return swung(closedFront(), 0.04 + 0.3 * t); };
  NoisyDetector detect(17);
  RectangleTracker tracker({});
  for (int i = 0; i < 45; ++i) {
    const double t = i * kFrame;
    DetectedRectangle detection = detect.plain(door(t));
    if (i < 6) detection = withHiddenEdge(detection, kEdgeMinusX, -0.02 * (6 - i));
    tracker.process(t, {detection});
  }
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].observations.size(), 45u);
  EXPECT_GT(tracker.tracks()[0].revision, 0u);
  EXPECT_LT(largestError(tracker.tracks()[0], door), 0.02) << "also the first ones, once the size is known";
}

TEST(RectangleTracker, AWrongFirstSizeThatLookedCertainIsCorrected) {
  const auto drawer = [](double t) { return pulled(closedFront(0, 0.395, 0.125), 0.02 + 0.2 * t); };
  RectangleTracker tracker({});
  NoisyDetector detect(18);
  for (int i = 0; i < 30; ++i) {
    DetectedRectangle detection = detect.plain(drawer(i * kFrame));
    detection.edge_support[kEdgePlusY] = 0.55F;
    if (i == 0) {
      detection.rectangle.height += 0.043;
      detection.rectangle.pose.translate(Eigen::Vector3d(0, 0.0215, 0));
    }
    tracker.process(i * kFrame, {detection});
  }
  ASSERT_EQ(tracker.tracks().size(), 1u);
  const Track& track = tracker.tracks()[0];
  EXPECT_EQ(track.observations.size(), 30u);
  EXPECT_LT((track.observations[0].rectangle.center() - drawer(0).center()).norm(), 0.01) << "21 mm off as measured";
}

TEST(RectangleTracker, SizeIsDefinedWhenEdgesAreNeverObserved) {
  RectangleTracker tracker({});
  NoisyDetector detect(19);
  for (int i = 1; i <= 20; ++i) {
    DetectedRectangle detection = detect(closedFront());
    detection.edge_support = {0, 0, 0, 0};
    tracker.process(i * kFrame, {detection});
  }
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_NEAR(std::min(tracker.tracks()[0].width, tracker.tracks()[0].height), 0.395, 0.005);
}

TEST(RectangleTracker, OldAndBadStampsChangeNothing) {
  RectangleTracker tracker({});
  NoisyDetector detect(41);
  tracker.process(1, {detect(closedFront())});
  for (double stamp : {1.0, 0.5, std::nan(""), std::numeric_limits<double>::infinity()})
    tracker.process(stamp, {detect(closedFront())});
  ASSERT_EQ(tracker.tracks().size(), 1u);
  EXPECT_EQ(tracker.tracks()[0].observations.size(), 1u);
  tracker.process(1.1, {detect(closedFront())});
  EXPECT_EQ(tracker.tracks()[0].observations.size(), 2u);
}

TEST(RectangleTracker, BadRectanglesAreIgnored) {
  NoisyDetector detect(43);
  const double nan = std::nan("");
  std::vector<DetectedRectangle> bad(6, detect(closedFront()));
  bad[0].rectangle.pose.translation().x() = nan;
  bad[1].rectangle.pose.linear()(1, 1) = std::numeric_limits<double>::infinity();
  bad[2].rectangle.width = nan;
  bad[3].rectangle.height = 0;
  bad[4].rectangle.pose.linear() *= 2;
  bad[5].covariance(3, 3) = nan;
  RectangleTracker tracker({});
  EXPECT_TRUE(tracker.process(1, bad).empty());
  bad.push_back(detect(closedFront()));
  EXPECT_EQ(tracker.process(2, bad).size(), 1u);
}

TEST(RectangleTracker, NoRectanglesAreFine) {
  RectangleTracker tracker({});
  EXPECT_TRUE(tracker.process(1, {}).empty());
  EXPECT_TRUE(tracker.expected().fronts.empty());
}

TEST(RectangleTracker, RefusesBadSettings) {
  TrackingConfig config;
  config.timeout = -1;
  EXPECT_THROW(RectangleTracker{config}, ConfigError);
}

}  // namespace
}  // namespace cabinet_articulation::core
