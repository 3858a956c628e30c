// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/observations/ambiguous_turns.h"

#include <gtest/gtest.h>

#include <random>
#include <tuple>

#include "articulation/synthetic_tracks.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kQuarter = M_PI / 2;

Eigen::Isometry3d aboutZ(double angle) { return Eigen::Isometry3d(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ())); }

/// `share` of the poses come in another description, or relative to a marker that made a quarter turn.
Track misdescribed(Track track, double share, bool of_the_reference, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform;
  for (TrackedObservation& observation : track.observations) {
    if (uniform(random) >= share) continue;
    const Eigen::Isometry3d turn = aboutZ(kQuarter * (1 + random() % 3));
    Eigen::Isometry3d& pose = observation.rectangle.pose;
    pose = of_the_reference ? turn * pose : pose * turn;
    if (!of_the_reference && random() % 2) pose = pose * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX());
  }
  return track;
}

Track ofMarker(const SyntheticFront& front) {
  Track track = syntheticTrack(front);
  track.width = track.height = 0;
  for (TrackedObservation& observation : track.observations) observation.rectangle.width = observation.rectangle.height = 0;
  return track;
}

TEST(AmbiguousTurns, EachDescriptionOfAPoseIsResolved) {
  const Eigen::Isometry3d pose = closedPose();
  for (int quarters = 0; quarters < 4; ++quarters)
    for (const double back : {0.0, M_PI}) {
      AmbiguousTurns turns(0.01, 0.1);
      turns.resolve(pose);
      const Eigen::Isometry3d other = pose * aboutZ(kQuarter * quarters) * Eigen::AngleAxisd(back, Eigen::Vector3d::UnitX());
      const AmbiguousTurns::Resolved resolved = turns.resolve(other);
      EXPECT_TRUE(resolved.pose.isApprox(pose, 1e-9)) << quarters << " " << back;
      EXPECT_EQ(resolved.swaps_sides, quarters % 2 == 1);
      EXPECT_TRUE(turns.resolve(aboutZ(kQuarter * quarters) * pose).pose.isApprox(pose, 1e-9)) << quarters;
    }
}

TEST(AmbiguousTurns, MotionIsNotUndone) {
  AmbiguousTurns turns(0.01, 0.1);
  const SyntheticFront front = door();
  for (const double q : {0.0, 0.4, 0.8, 1.57, 0.0})
    EXPECT_TRUE(turns.resolve(truePose(front, q)).pose.isApprox(truePose(front, q), 1e-12));
}

TEST(AmbiguousTurns, WhatMostPosesSayIsRight) {
  AmbiguousTurns turns(0.01, 0.1);
  const Eigen::Isometry3d pose = closedPose();
  turns.resolve(pose * aboutZ(kQuarter));
  Eigen::Isometry3d resolved = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 5; ++i) resolved = turns.resolve(pose).pose;
  EXPECT_TRUE(turns.most()(resolved).isApprox(pose, 1e-9));
}

class Misdescribed : public ::testing::TestWithParam<std::tuple<JointType, double, bool>> {};

TEST_P(Misdescribed, TracksAreLearned) {
  const auto [type, share, of_the_reference] = GetParam();
  int right = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SyntheticFront front = type == JointType::kPrismatic ? drawer() : door();
    front.seed = seed;
    const LearnedModel model = learn(misdescribed(ofMarker(front), share, of_the_reference, seed));
    right += model.moved && model.explained && model.type == type;
  }
  EXPECT_GE(right, 10);
}

INSTANTIATE_TEST_SUITE_P(All, Misdescribed,
                         ::testing::Combine(::testing::Values(JointType::kPrismatic, JointType::kRotational),
                                            ::testing::Values(0.1, 0.3, 0.45), ::testing::Bool()));

}  // namespace
}  // namespace cabinet_articulation::core
