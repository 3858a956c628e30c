// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/track_updates.h"

#include <gtest/gtest.h>

#include "tracking/motion/history.h"
#include "tracking/synthetic_fronts.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kFrame = 1.0 / 15;

/// A tracker's tracks, and somebody who puts them together.
class TrackUpdatesTest : public testing::Test {
 protected:
  static Track trackOf(std::uint32_t id) {
    Track track;
    track.id = id;
    track.width = 0.395;
    track.height = 0.58;
    return track;
  }

  void observe(Track* track) {
    TrackedObservation observation;
    observation.stamp = now_;
    observation.rectangle = pulled(closedFront(), 0.001 * static_cast<double>(track->observations.size()));
    track->observations.push_back(observation);
  }

  /// One frame in which the first `seen` tracks are seen.
  std::vector<TrackUpdate> frame(size_t seen) {
    now_ += kFrame;
    for (size_t i = 0; i < seen; ++i) observe(&tracks_[i]);
    return updates_.of(tracks_, now_);
  }

  void expectSame() const {
    ASSERT_EQ(assembly_.tracks().size(), tracks_.size());
    for (size_t i = 0; i < tracks_.size(); ++i) {
      const Track& put_together = assembly_.tracks()[i];
      EXPECT_EQ(put_together.id, tracks_[i].id);
      EXPECT_EQ(put_together.revision, tracks_[i].revision);
      EXPECT_EQ(put_together.width, tracks_[i].width);
      EXPECT_EQ(put_together.hollow, tracks_[i].hollow);
      ASSERT_EQ(put_together.observations.size(), tracks_[i].observations.size());
      for (size_t k = 0; k < tracks_[i].observations.size(); ++k) {
        EXPECT_EQ(put_together.observations[k].stamp, tracks_[i].observations[k].stamp);
        EXPECT_EQ(put_together.observations[k].rectangle.pose.matrix(), tracks_[i].observations[k].rectangle.pose.matrix());
      }
    }
    EXPECT_EQ(assembly_.waiting(), 0u);
  }

  double now_ = 1000;
  std::vector<Track> tracks_{trackOf(1)};
  TrackUpdates updates_;
  TrackAssembly assembly_;
};

TEST_F(TrackUpdatesTest, HoldWhatIsNewAfterTheLastThatIsKnown) {
  for (int i = 0; i < 30; ++i) {
    const bool seen = i % 3 != 2;
    const std::vector<TrackUpdate> updates = frame(seen);
    ASSERT_EQ(updates.size(), 1u);
    EXPECT_EQ(updates[0].track.observations.size(), seen && i > 0 ? 2u : 1u) << i;
    EXPECT_EQ(updates[0].first + updates[0].track.observations.size(), tracks_[0].observations.size()) << i;
    assembly_.add(updates);
    expectSame();
  }
}

TEST_F(TrackUpdatesTest, SayThatAFrontWasSeenToBeHollow) {
  assembly_.add(frame(1));
  tracks_[0].hollow = true;
  assembly_.add(frame(1));
  expectSame();
}

TEST_F(TrackUpdatesTest, AreWholeWhereEarlierObservationsChanged) {
  for (int i = 0; i < 20; ++i) assembly_.add(frame(1));
  ++tracks_[0].revision;
  tracks_[0].width = 0.4;
  tracks_[0].observations[3].rectangle = closedFront(0.1);
  std::vector<TrackUpdate> updates = frame(1);
  EXPECT_EQ(updates[0].first, 0u);
  assembly_.add(updates);
  expectSame();
  ASSERT_TRUE(thinOut(tracks_[0].observations, 16));
  updates = frame(1);
  EXPECT_EQ(updates[0].first, 0u);
  assembly_.add(updates);
  expectSame();
  // As many as before, but others.
  tracks_[0].observations.erase(tracks_[0].observations.begin() + 3);
  updates = frame(1);
  EXPECT_EQ(updates[0].first, 0u);
  assembly_.add(updates);
  expectSame();
}

TEST_F(TrackUpdatesTest, AreWholeForWhoeverJoins) {
  for (int i = 0; i < 20; ++i) frame(1);
  assembly_.add(frame(1));
  EXPECT_TRUE(assembly_.tracks().empty()) << "its beginning is not known";
  EXPECT_EQ(assembly_.waiting(), 1u);
  updates_.startAnew();
  assembly_.add(frame(1));
  expectSame();
}

TEST_F(TrackUpdatesTest, AMissedOneLeavesAGapForSomeSecondsAtMost) {
  for (int i = 0; i < 20; ++i) assembly_.add(frame(1));
  frame(1);
  const double lost = now_;
  assembly_.add(frame(1));
  EXPECT_EQ(assembly_.waiting(), 1u);
  ASSERT_EQ(assembly_.tracks().size(), 1u);
  EXPECT_EQ(assembly_.tracks()[0].observations.size(), 20u) << "what was there stays";
  while (assembly_.waiting() > 0 && now_ < lost + 60) assembly_.add(frame(1));
  EXPECT_LE(now_ - lost, TrackUpdates::kWholePeriod);
  expectSame();
}

TEST_F(TrackUpdatesTest, AMissedThinningIsAGap) {
  for (int i = 0; i < 40; ++i) assembly_.add(frame(1));
  ASSERT_TRUE(thinOut(tracks_[0].observations, 32));
  frame(1);
  assembly_.add(frame(1));
  EXPECT_EQ(assembly_.waiting(), 1u);
  EXPECT_EQ(assembly_.tracks().at(0).observations.size(), 40u) << "as it was, though there are as many as needed";
  updates_.startAnew();
  assembly_.add(frame(1));
  expectSame();
}

TEST_F(TrackUpdatesTest, AnotherRevisionIsNoContinuation) {
  for (int i = 0; i < 20; ++i) assembly_.add(frame(1));
  ++tracks_[0].revision;
  frame(1);
  assembly_.add(frame(1));
  EXPECT_EQ(assembly_.waiting(), 1u);
  EXPECT_EQ(assembly_.tracks().at(0).observations.size(), 20u);
}

TEST_F(TrackUpdatesTest, WholeOnesTakeTurns) {
  for (std::uint32_t id = 2; id <= 5; ++id) tracks_.push_back(trackOf(id));
  // Of two observations, the one that is known is the first.
  for (int i = 0; i < 2; ++i) frame(tracks_.size());
  int whole = 0;
  for (int i = 0; i < 20 / kFrame; ++i) {
    int in_frame = 0;
    for (const TrackUpdate& update : frame(tracks_.size())) in_frame += update.first == 0;
    EXPECT_LE(in_frame, 1);
    whole += in_frame;
  }
  EXPECT_GE(whole, 3 * 5);
  EXPECT_LE(whole, 4 * 5);
}

TEST_F(TrackUpdatesTest, ComeAndGoWithTheTracks) {
  tracks_.push_back(trackOf(2));
  for (int i = 0; i < 10; ++i) assembly_.add(frame(2));
  const Track first = tracks_[0];
  tracks_.erase(tracks_.begin());
  assembly_.add(frame(1));
  expectSame();
  ASSERT_EQ(assembly_.ended().size(), 1u);
  EXPECT_EQ(assembly_.ended()[0].observations.size(), 10u);
  tracks_.insert(tracks_.begin(), first);
  const std::vector<TrackUpdate> updates = frame(2);
  EXPECT_EQ(updates[0].first, 0u);
  assembly_.add(updates);
  expectSame();
  EXPECT_TRUE(assembly_.ended().empty());
}

}  // namespace
}  // namespace cabinet_articulation::core
