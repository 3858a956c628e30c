// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "articulation/synthetic_tracks.h"

namespace cabinet_articulation::core {
namespace {

/// A front seen `poses` times by a good detector, which says how certain it is.
Track reported(SyntheticFront front, int poses, double q_start, double q_end) {
  front.poses = poses;
  front.q_start = q_start;
  front.q_end = q_end;
  front.noise = 0.001;
  front.turn_noise = 0.003;
  return reported(syntheticTrack(front), front.noise, front.turn_noise);
}

TEST(EarlyDecision, TwoPosesTellADoor) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SyntheticFront front = door();
    front.seed = seed;
    const LearnedModel model = learn(reported(front, 2, 0.1, 0.2));
    EXPECT_TRUE(model.moved) << seed;
    EXPECT_GT(probability(model, JointType::kRotational), 0.9) << seed;
    // 0.25 degrees of noise in either pose against a turn of 5.7 degrees.
    EXPECT_LT(angleBetweenLines(model.axis, trueAxis(front)), 0.15) << seed;
  }
}

TEST(EarlyDecision, TwoPosesTellADrawer) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SyntheticFront front = drawer();
    front.seed = seed;
    const LearnedModel model = learn(reported(front, 2, 0.04, 0.08));
    EXPECT_TRUE(model.moved) << seed;
    EXPECT_EQ(model.type, JointType::kPrismatic) << seed;
    EXPECT_LT(angleBetweenLines(model.axis, trueAxis(front)), 0.15) << seed;
  }
}

TEST(EarlyDecision, ErrorsAreThoseOfTheOrientationsThemselves) {
  const LearnedModel model = learn(reported(door(), 40, 0.1, 1.2));
  // 3 mrad in each direction, and about the axis 5 more by which 1 mm at 20 cm misplaces q. The mean is sqrt(8 / pi / 3) of their
  // norm.
  EXPECT_NEAR(model.orientation_error, 0.92 * std::sqrt(3 * 0.003 * 0.003 + 0.005 * 0.005), 0.0012);
}

TEST(EarlyDecision, TwoPosesThatDoNotSayHowCertainTheyAreTellNothing) {
  Track track = reported(door(), 2, 0.1, 0.2);
  for (TrackedObservation& observation : track.observations) observation.covariance.setZero();
  EXPECT_FALSE(learn(track).moved);
}

TEST(EarlyDecision, MotionWithinWhatIsUncertainIsNone) {
  Track track = reported(drawer(), 2, 0.04, 0.08);
  // 4 cm between poses of 14 mm each: two standard deviations.
  for (TrackedObservation& observation : track.observations) observation.covariance *= 200;
  EXPECT_FALSE(learn(track).moved) << "1 cm and more of noise in either pose";
  for (int poses = 2; poses <= 5; ++poses) EXPECT_FALSE(learn(reported(drawer(), poses, 0.04, 0.05)).moved) << poses;
}

TEST(EarlyDecision, WhatIsSeenNowAndThenIsNoFront) {
  Track track = reported(door(), 4, 0.1, 0.4);
  EXPECT_TRUE(learn(track).moved);
  for (std::size_t i = 2; i < track.observations.size(); ++i) track.observations[i].stamp += 0.5;
  EXPECT_FALSE(learn(track).moved);
}

TEST(EarlyDecision, TwoObservationsOfDifferentSizesAreOfTwoThings) {
  Track track = reported(drawer(), 2, 0.04, 0.08);
  for (TrackedObservation& observation : track.observations) observation.measured = observation.rectangle;
  EXPECT_TRUE(learn(track).moved);
  track.observations[1].measured.width /= 3;
  EXPECT_FALSE(learn(track).moved);
}

TEST(EarlyDecision, WhatTurnsAtOnceIsNoFront) {
  EXPECT_TRUE(learn(reported(door(), 2, 0.1, 0.2)).moved) << "1.5 rad/s";
  EXPECT_FALSE(learn(reported(door(), 2, 0.1, 0.4)).moved) << "4.5 rad/s";
}

TEST(EarlyDecision, AHingeLiesAtTheFront) {
  // A strip of an arm that turns about an elbow far outside.
  Track track = reported(door(), 4, 0.1, 0.5);
  for (TrackedObservation& observation : track.observations) {
    observation.rectangle.pose.translate(Eigen::Vector3d(0.3, 0, 0));
    observation.rectangle.width = 0.2;
    observation.rectangle.height = 0.07;
  }
  track.width = 0.2;
  track.height = 0.07;
  EXPECT_FALSE(learn(track).moved);
}

TEST(EarlyDecision, AFaceThatSeemsToTiltForAMomentDoesNotMove) {
  // A plane at rest takes in parts of a drawer that comes out of it, until that has left it.
  Track track = reported(door(), 40, 0, 0);
  SyntheticFront front = door();
  for (int i = 0; i < 5; ++i)
    track.observations[static_cast<std::size_t>(20 + i)].rectangle.pose = truePose(front, 0.012 * (i + 1));
  EXPECT_FALSE(learn(track).moved);
}

}  // namespace
}  // namespace cabinet_articulation::core
