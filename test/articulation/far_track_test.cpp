// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/geometry/limits.h"

namespace cabinet_articulation::core {
namespace {

/// A door of this size and place that opens by a radian.
Track doorTrack(const Eigen::Vector3d& hinge, double width, double height) {
  Track track;
  track.id = 1;
  track.width = width;
  track.height = height;
  for (int i = 0; i <= 40; ++i) {
    TrackedObservation observation;
    observation.stamp = i;
    const Eigen::AngleAxisd turn(i / 40.0, Eigen::Vector3d::UnitY());
    observation.rectangle = {Eigen::Translation3d(hinge) * turn * Eigen::Translation3d(width / 2, 0, 0), width, height};
    observation.measured = observation.rectangle;
    track.observations.push_back(observation);
  }
  return track;
}

/// What the limits let in must not lose its digits, nor overflow, in the fits.
TEST(FarTrack, IsLearnedAtTheEdgeOfEveryMap) {
  const double far = limits::kFromOrigin.max - 1;
  const LearnedModel model = fitAllModels(doorTrack({far, -far, far}, 0.4, 0.6), ArticulationConfig()).at(0);
  EXPECT_EQ(model.type, JointType::kRotational);
  EXPECT_NEAR(model.radius, 0.2, 1e-3) << "of the front's centre";
}

TEST(FarTrack, IsAnsweredForTheSmallestAndTheLargestFronts) {
  const double far = limits::kFromOrigin.max;
  for (const double side : {limits::kSide.min, limits::kSide.max})
    for (const double x : {0.0, far - 10})
      EXPECT_FALSE(fitAllModels(doorTrack({x, 0, 1}, side, side), ArticulationConfig()).empty()) << side << " at " << x;
}

}  // namespace
}  // namespace cabinet_articulation::core
