// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/motion_threshold.h"

#include <gtest/gtest.h>

#include <cmath>

#include "articulation/synthetic_tracks.h"
#include "cabinet_articulation/articulation/front_poses.h"

namespace cabinet_articulation::core {
namespace {

MotionThreshold thresholdOf(const Track& track, const ArticulationConfig& config = {}) {
  FrontPoses poses(config);
  poses.update(track);
  return motionThreshold(track, poses.track({}, poses.size()), config);
}

SyntheticFront noisy(double noise) {
  SyntheticFront front;
  front.noise = noise;
  front.poses = 200;
  return front;
}

TEST(MotionThreshold, GrowsWithTheJitterFromPoseToPose) {
  // The door's steady turning adds nothing; 200 poses know their noise to some 10 %.
  EXPECT_NEAR(thresholdOf(syntheticTrack(noisy(0.01))).path, 10 * 0.01, 0.02);
  EXPECT_NEAR(thresholdOf(syntheticTrack(noisy(0.03))).path, 10 * 0.03, 0.06);
}

TEST(MotionThreshold, IsAtLeastTheConfiguredOne) {
  EXPECT_EQ(thresholdOf(syntheticTrack(noisy(0.0005))).path, ArticulationConfig().motion_min);
}

TEST(MotionThreshold, IsInfiniteForFewPosesAndForFrontsWithoutVisibleEdges) {
  SyntheticFront front = noisy(0.003);
  front.poses = 4;
  EXPECT_TRUE(std::isinf(thresholdOf(syntheticTrack(front)).path));
  Track track = syntheticTrack(noisy(0.003));
  for (TrackedObservation& observation : track.observations) observation.edge_support = {0.9F, 0, 0.5F, 0.4F};
  EXPECT_TRUE(std::isinf(thresholdOf(track).path));
  EXPECT_TRUE(std::isinf(thresholdOf(track).angle));
}

TEST(MotionThreshold, ClutterThatJumpsBetweenTwoPlacesDoesNotMove) {
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
