// SPDX-License-Identifier: BSD-3-Clause
#include "scores/merged_models.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cabinet_articulation::core::evaluation {
namespace {

/// Positions of a door of `radius` that begins at x = `place` and turns about the axis at its left.
Track doorTrack(double radius, double place, double turn) {
  Track track;
  for (int i = 0; i <= 40; ++i) {
    const double angle = turn * i / 40;
    TrackedObservation observation;
    observation.stamp = i;
    observation.rectangle.pose.translation() << place + radius * (std::cos(angle) - 1), 0, -radius * std::sin(angle);
    track.observations.push_back(observation);
  }
  return track;
}

ArticulationConfig positionsOnly() {
  ArticulationConfig config;
  config.use_orientation = false;
  return config;
}

TEST(MergedModels, ADoorThatHardlyOpenedIsTheOneThatDidElsewhere) {
  MergedModels models(positionsOnly());
  models.store(doorTrack(0.4, 0, 1.5));
  const LearnedModel door = models.modelOf(doorTrack(0.4, 3, 0.2));
  EXPECT_EQ(door.type, JointType::kRotational);
  EXPECT_NEAR(door.radius, 0.4, 0.002);
  EXPECT_LT((door.axis_point - Eigen::Vector3d(2.6, 0, 0)).norm(), 0.002);
}

TEST(MergedModels, AnotherDoorHasAModelOfItsOwn) {
  MergedModels models(positionsOnly());
  models.store(doorTrack(0.4, 0, 1.5));
  const LearnedModel door = models.modelOf(doorTrack(0.7, 3, 1));
  EXPECT_NEAR(door.radius, 0.7, 0.002);
}

}  // namespace
}  // namespace cabinet_articulation::core::evaluation
