// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/motion_criterion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "articulation/synthetic_tracks.h"
#include "cabinet_articulation/articulation/front_poses.h"

namespace cabinet_articulation::core {
namespace {

/// [m] of the front's centre
double jitterOf(const Track& track) {
  const ArticulationConfig config;
  FrontPoses poses(config);
  poses.update(track);
  return MotionCriterion(track, poses.track({}, poses.size()), config).jitter().at(0);
}

SyntheticFront noisy(double noise) {
  SyntheticFront front;
  front.noise = noise;
  front.poses = 200;
  return front;
}

TEST(MotionCriterion, JitterIsTheNoiseFromPoseToPose) {
  // The door's steady turning adds nothing; 200 poses know their noise to some 10 %.
  EXPECT_NEAR(jitterOf(syntheticTrack(noisy(0.01))), 0.01, 0.002);
  EXPECT_NEAR(jitterOf(syntheticTrack(noisy(0.03))), 0.03, 0.006);
}

TEST(MotionCriterion, UnevenMotionIsNoJitter) {
  Track track = syntheticTrack(noisy(0.0002));
  Track uneven = track;
  uneven.observations.clear();
  for (std::size_t i = 0; i < track.observations.size(); i += 1 + (i * i) % 23)
    uneven.observations.push_back(track.observations[i]);
  EXPECT_LT(jitterOf(uneven), 0.001);
}

TEST(MotionCriterion, NoMotionInFewPosesOrWithoutVisibleEdges) {
  SyntheticFront front = noisy(0.001);
  front.poses = 2;
  EXPECT_FALSE(learn(syntheticTrack(front)).moved);
  Track track = syntheticTrack(noisy(0.003));
  EXPECT_TRUE(learn(track).moved);
  for (TrackedObservation& observation : track.observations) observation.edge_support = {0.9F, 0, 0.5F, 0.4F};
  EXPECT_FALSE(learn(track).moved);
}

TEST(MotionCriterion, SlowDriftOfACentimetreIsNoMotion) {
  SyntheticFront front = noisy(0.001);
  front.type = JointType::kPrismatic;
  front.q_end = 0.01;
  front.turn_noise = 0.003;
  for (front.seed = 1; front.seed <= 5; ++front.seed) EXPECT_FALSE(learn(syntheticTrack(front)).moved) << front.seed;
}

TEST(MotionCriterion, ClutterThatJumpsBetweenTwoPlacesDoesNotMove) {
  SyntheticFront front = noisy(0.008);
  front.type = JointType::kRigid;
  front.turn_noise = 0.1;
  Track track = syntheticTrack(front);
  for (size_t i = 0; i < track.observations.size(); i += 3)
    track.observations[i].rectangle.pose.pretranslate(Eigen::Vector3d(0.06, 0, 0.03));
  const LearnedModel model = learn(track);
  EXPECT_FALSE(model.moved);
}

}  // namespace
}  // namespace cabinet_articulation::core
