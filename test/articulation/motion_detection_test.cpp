// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/decision/motion_detection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "articulation/observations/observation_history.h"
#include "articulation/synthetic_tracks.h"

namespace cabinet_articulation::core {
namespace {

/// [m] of the front's centre
double jitterOf(const Track& track) {
  const ArticulationConfig config;
  ObservationHistory poses(config);
  poses.update(track);
  return MotionDetector(track, poses.evenlySpaced({}, poses.size()), config).jitter().at(0);
}

SyntheticFront noisy(double noise) {
  SyntheticFront front;
  front.noise = noise;
  front.poses = 200;
  return front;
}

TEST(MotionDetector, JitterIsTheNoiseFromPoseToPose) {
  // The door's steady turning adds nothing; 200 poses know their noise to some 10 %.
  EXPECT_NEAR(jitterOf(syntheticTrack(noisy(0.01))), 0.01, 0.002);
  EXPECT_NEAR(jitterOf(syntheticTrack(noisy(0.03))), 0.03, 0.006);
}

TEST(MotionDetector, UnevenMotionIsNoJitter) {
  Track track = syntheticTrack(noisy(0.0002));
  Track uneven = track;
  uneven.observations.clear();
  for (std::size_t i = 0; i < track.observations.size(); i += 1 + (i * i) % 23)
    uneven.observations.push_back(track.observations[i]);
  EXPECT_LT(jitterOf(uneven), 0.001);
}

TEST(MotionDetector, AWayOfAFewLargeStepsIsNotRestless) {
  // A door that is seen well in few frames while it opens, and at rest from then on.
  const double opened[] = {0, 0.12, 0.3, 0.31, 0.31, 0.31, 0.31, 0.31, 0.31, 0.31, 0.31, 0.31};
  Track whole = syntheticTrack(noisy(0.0002)), track = whole;
  track.observations.clear();
  ArticulationLearner learner({});
  for (const double q : opened) {
    const auto nearest = static_cast<std::size_t>(std::lround(q / 1.2 * 199));
    track.observations.push_back(whole.observations[nearest]);
    track.observations.back().stamp = 10 + static_cast<double>(track.observations.size()) / 15;
    track.observations.back().covariance.diagonal() << 1e-6, 1e-6, 1e-6, 1e-4, 1e-4, 1e-4;
    const LearnedModel model = learner.process({track}).at(0);
    if (track.observations.size() >= 3) {
      EXPECT_TRUE(model.moved) << track.observations.size() << " poses";
    }
    const LearnedModel at_once = learn(track);
    if (track.observations.size() >= 6) {
      EXPECT_TRUE(at_once.moved) << track.observations.size() << " poses at once";
    }
  }
}

TEST(MotionDetector, NoMotionInFewPosesOrWithoutVisibleEdges) {
  SyntheticFront front = noisy(0.001);
  front.poses = 2;
  EXPECT_FALSE(learn(syntheticTrack(front)).moved);
  Track track = syntheticTrack(noisy(0.003));
  EXPECT_TRUE(learn(track).moved);
  for (TrackedObservation& observation : track.observations) observation.edge_support = {0.4F, 0, 0.2F, 0.2F};
  EXPECT_FALSE(learn(track).moved);
}

TEST(MotionDetector, ATallDoorThatTheImageCutsTurnsClearly) {
  Track track = syntheticTrack(noisy(0.003));
  for (TrackedObservation& observation : track.observations) observation.edge_support = {0.8F, 0.9F, 0, 0};
  EXPECT_TRUE(learn(track).moved);
}

TEST(MotionDetector, SlowDriftOfACentimetreIsNoMotion) {
  SyntheticFront front = noisy(0.001);
  front.type = JointType::kPrismatic;
  front.q_end = 0.01;
  front.turn_noise = 0.003;
  for (front.seed = 1; front.seed <= 5; ++front.seed) EXPECT_FALSE(learn(syntheticTrack(front)).moved) << front.seed;
}

TEST(MotionDetector, ClutterThatJumpsBetweenTwoPlacesDoesNotMove) {
  SyntheticFront front = noisy(0.008);
  front.type = JointType::kRigid;
  front.turn_noise = 0.1;
  Track track = syntheticTrack(front);
  for (size_t i = 0; i < track.observations.size(); i += 3)
    track.observations[i].rectangle.pose.pretranslate(Eigen::Vector3d(0.06, 0, 0.03));
  const LearnedModel model = learn(track);
  EXPECT_FALSE(model.moved);
}

TEST(MotionDetector, AFaceThatTiltsToAndFroDoesNotMove) {
  SyntheticFront front = still();
  front.width = 0.12;
  front.height = 0.2;
  front.turn_noise = 0.02;
  for (front.seed = 1; front.seed <= 10; ++front.seed) {
    Track track = syntheticTrack(front);
    std::mt19937 random(front.seed);
    std::normal_distribution<double> tilt(0, 0.3);
    for (TrackedObservation& observation : track.observations)
      observation.rectangle.pose.rotate(Eigen::AngleAxisd(tilt(random), Eigen::Vector3d::UnitY()));
    EXPECT_FALSE(learn(reported(track, 0.003, 0.03)).moved) << front.seed;
  }
}

TEST(MotionDetector, ADoorThatStandsOpenWithHardlyAnEdgeInSightStaysKnown) {
  SyntheticFront front = noisy(0.002);
  front.poses = 20;
  Track track = syntheticTrack(front);
  front.q_start = front.q_end;
  front.poses = 200;
  front.seed = 2;
  for (TrackedObservation observation : syntheticTrack(front).observations) {
    observation.stamp += 20 * front.period;
    observation.edge_support = {0.7F, 0, 0.3F, 0.7F};
    track.observations.push_back(observation);
  }
  const LearnedModel model = learn(track);
  EXPECT_TRUE(model.moved);
  EXPECT_EQ(model.type, JointType::kRotational);
}

TEST(MotionDetector, AFrontThatStandsOpenForLongMovedAllTheSame) {
  for (SyntheticFront front : {door(), drawer()}) {
    front.noise = 0.002;
    front.poses = 30;
    Track track = syntheticTrack(front);
    front.q_start = front.q_end;
    front.poses = 800;
    for (TrackedObservation observation : syntheticTrack(front).observations) {
      observation.stamp += 30 * front.period;
      track.observations.push_back(observation);
    }
    EXPECT_GT(probability(learn(track), front.type), 0.95);
    EXPECT_GT(probability(learn(reported(track, 0.003, 0.01)), front.type), 0.95);
  }
}

TEST(MotionDetector, WhatIsAsNarrowAsAnArmHasToMoveForLonger) {
  SyntheticFront front = drawer();
  front.height = 0.07;
  front.poses = 15;
  EXPECT_FALSE(learn(syntheticTrack(front)).moved);
  front.poses = 30;
  EXPECT_TRUE(learn(syntheticTrack(front)).moved);
}

TEST(MotionDetector, FacesOfSomethingRoundDoNotTurnAboutItsMiddle) {
  constexpr double kRadius = 0.06;  // of a can, of which ever other sides are seen
  SyntheticFront front = still();
  front.width = 0.12;
  front.height = 0.2;
  front.poses = 40;
  Track track = syntheticTrack(front);
  for (std::size_t i = 0; i < track.observations.size(); ++i) {
    Eigen::Isometry3d& pose = track.observations[i].rectangle.pose;
    pose = pose * Eigen::Translation3d(0, 0, -kRadius) * Eigen::AngleAxisd(0.035 * i, Eigen::Vector3d::UnitY()) *
           Eigen::Translation3d(0, 0, kRadius);
  }
  EXPECT_FALSE(learn(reported(track, 0.003, 0.02)).moved);
}

TEST(MotionDetector, AnArmOfWhichOneEndIsNeverSeenIsNoFront) {
  SyntheticFront front = drawer();
  front.height = 0.07;
  Track track = syntheticTrack(front);
  EXPECT_TRUE(learn(track).moved);
  for (TrackedObservation& observation : track.observations) observation.edge_support = {0.8F, 0, 0.9F, 0.8F};
  EXPECT_FALSE(learn(track).moved);
}

}  // namespace
}  // namespace cabinet_articulation::core
