// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>

#include "articulation/synthetic_tracks.h"
#include "cabinet_articulation/articulation/articulation_learner.h"

namespace cabinet_articulation::core {
namespace {

TEST(BadTracks, ATrackWithoutUsablePosesHasNoModel) {
  Track track;
  EXPECT_TRUE(ArticulationLearner({}).process({track}).empty());
  track = syntheticTrack(door());
  for (TrackedObservation& observation : track.observations)
    observation.rectangle.pose.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(ArticulationLearner({}).process({track}).empty());
}

TEST(BadTracks, KeepsWhatItLearnedWhenBadInputComes) {
  Track track = syntheticTrack(door());
  ArticulationLearner learner({});
  const LearnedModel before = learner.process({track}).at(0);
  for (TrackedObservation& observation : track.observations)
    observation.rectangle.pose.linear() *= std::numeric_limits<double>::quiet_NaN();
  track.observations.pop_back();
  const std::vector<LearnedModel> after = learner.process({track});
  ASSERT_EQ(after.size(), 1u);
  EXPECT_EQ(after[0].radius, before.radius);
}

TEST(BadTracks, IgnoresSinglePosesThatAreNotFinite) {
  Track track = syntheticTrack(door());
  const LearnedModel clean = learn(track);
  track.observations[50].rectangle.pose.translation().y() = std::numeric_limits<double>::infinity();
  track.observations[60].rectangle.pose.linear().setZero();
  track.observations[70].covariance.setConstant(std::numeric_limits<double>::quiet_NaN());
  track.observations[80].rectangle.width = std::numeric_limits<double>::quiet_NaN();
  const LearnedModel model = learn(track);
  EXPECT_EQ(model.type, JointType::kRotational);
  EXPECT_NEAR(model.radius, clean.radius, 0.002);
}

TEST(BadTracks, OnePoseIsRigid) {
  SyntheticFront front = door();
  front.poses = 1;
  const LearnedModel model = learn(syntheticTrack(front));
  EXPECT_FALSE(model.moved);
  EXPECT_EQ(model.type, JointType::kRigid);
  EXPECT_EQ(model.observations, 1);
  EXPECT_TRUE(model.covariance.allFinite());
}

TEST(BadTracks, IdenticalPosesAreRigid) {
  SyntheticFront front = still();
  front.noise = front.turn_noise = 0;
  const LearnedModel model = learn(syntheticTrack(front));
  EXPECT_FALSE(model.moved);
  EXPECT_LT((model.origin.translation() - closedPose().translation()).norm(), 1e-6);
}

TEST(BadTracks, StampsOutOfOrderAreSorted) {
  const Track track = syntheticTrack(door());
  Track shuffled = track;
  std::shuffle(shuffled.observations.begin(), shuffled.observations.end(), std::mt19937(5));
  const LearnedModel a = learn(track), b = learn(shuffled);
  EXPECT_EQ(a.radius, b.radius);
  EXPECT_EQ(a.probabilities, b.probabilities);
}

TEST(BadTracks, AJumpOfAMetreIsNotMotionAlongAJoint) {
  Track track = syntheticTrack(still());
  track.observations[50].rectangle.pose.pretranslate(Eigen::Vector3d(1, 0, 0));
  EXPECT_FALSE(learn(track).moved);
}

TEST(BadTracks, AJumpOfAMetreDoesNotSpoilADoor) {
  Track track = syntheticTrack(door());
  const LearnedModel clean = learn(track);
  track.observations[50].rectangle.pose.pretranslate(Eigen::Vector3d(1, 0, 0));
  const LearnedModel model = learn(track);
  EXPECT_EQ(model.type, JointType::kRotational);
  EXPECT_NEAR(model.radius, clean.radius, 0.004);
  EXPECT_NEAR(model.q_max, clean.q_max, 0.05);
}

TEST(BadTracks, RotationsThatAreNoneAreIgnored) {
  Track track = syntheticTrack(door());
  const LearnedModel clean = learn(track);
  for (std::size_t i = 0; i < track.observations.size(); i += 10) track.observations[i].rectangle.pose.linear() *= 1.5;
  const LearnedModel model = learn(track);
  EXPECT_EQ(model.observations, 90);
  EXPECT_EQ(model.type, JointType::kRotational);
  EXPECT_NEAR(model.radius, clean.radius, 0.006);
}

TEST(BadTracks, AHundredThousandPosesAreBounded) {
  SyntheticFront front = door();
  front.poses = 100000;
  const LearnedModel model = learn(syntheticTrack(front));
  EXPECT_EQ(model.type, JointType::kRotational);
  EXPECT_EQ(model.observations, 100000);
  EXPECT_NEAR(model.radius, 0.2, 0.004);
}

TEST(BadTracks, RefusesSettingsOutOfRange) {
  ArticulationConfig config;
  config.sigma_position = 0;
  EXPECT_THROW(ArticulationLearner{config}, ConfigError);
}

TEST(BadTracks, RefusesJointTypesThatDoNotExist) {
  ArticulationConfig config;
  for (const char* wrong : {"", "door", "all door", "rigid, prismatic", "nonparametric"}) {
    config.joint_types = wrong;
    EXPECT_THROW(ArticulationLearner{config}, ConfigError) << wrong;
  }
  for (const char* right : {"all", "rigid", " prismatic  rotational ", "all rigid"}) {
    config.joint_types = right;
    EXPECT_NO_THROW(ArticulationLearner{config}) << right;
  }
}

TEST(BadTracks, LearnsOnlyTheJointTypesThatAreChosen) {
  ArticulationConfig config;
  config.joint_types = "rigid prismatic";
  EXPECT_NE(learn(syntheticTrack(door()), config).type, JointType::kRotational);
  EXPECT_EQ(fitAllModels(syntheticTrack(door()), config).size(), 2u);
}

}  // namespace
}  // namespace cabinet_articulation::core
