// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/request_limits.h"

#include <gmock/gmock.h>

#include <limits>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/joints/joint.h"

namespace cabinet_articulation::core {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Rectangle front(double x, double width = 0.4, double height = 0.6) {
  return {Eigen::Isometry3d(Eigen::Translation3d(x, 0, 1)), width, height};
}

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

TEST(RequestLimits, ListsMayBeLongButNotEndless) {
  EXPECT_NO_THROW(requireFewEntries(kMostEntries, "ids"));
  EXPECT_THAT([] { requireFewEntries(kMostEntries + 1, "ids"); },
              ThrowsMessage<ModelError>(HasSubstr("there are 10001 ids, expected 10000 at most")));
}

TEST(RequestLimits, OpeningsAreThoseOfFronts) {
  EXPECT_NO_THROW(requireOpening(-kLargestOpening));
  EXPECT_THAT([] { requireOpening(1e300); }, ThrowsMessage<ModelError>("q is 1e+300 m or rad, expected -100 to 100 m or rad"));
  EXPECT_THAT([] { requireOpening(kNan); }, ThrowsMessage<ModelError>("q is not finite"));
}

TEST(RequestLimits, FrontsAreWithinASiteAndOfASize) {
  EXPECT_EQ(frontTrouble(front(-kFarthestPosition)), "");
  EXPECT_EQ(frontTrouble(front(0, 0, 0)), "") << "unknown";
  EXPECT_EQ(frontTrouble(front(1e155)), "x is 1e+155 m, expected -10000 to 10000 m");
  EXPECT_EQ(frontTrouble(front(kNan)), "x is nan m, expected -10000 to 10000 m");
  EXPECT_EQ(frontTrouble(front(0, 1e18)), "width is 1e+18 m, expected 0.001 to 100 m");
  EXPECT_EQ(frontTrouble(front(0, 0.4, -1)), "height is -1 m, expected 0.001 to 100 m");
  EXPECT_EQ(positionTrouble({0, 0, 3}, 2), "z is 3 m, expected -2 to 2 m");
}

TEST(RequestLimits, TheWrongPoseIsNamed) {
  Track track = doorTrack({0, 0, 1}, 0.4, 0.6);
  EXPECT_NO_THROW(requireSaneTrack(track));
  track.observations[7].measured.width = 1e18;
  EXPECT_THAT([&] { requireSaneTrack(track); }, ThrowsMessage<ModelError>(HasSubstr("measured pose 7: width is 1e+18 m")));
  track.observations[5].rectangle.pose.translation().z() = -1e155;
  EXPECT_THAT([&] { requireSaneTrack(track); }, ThrowsMessage<ModelError>(HasSubstr("pose 5: z is -1e+155 m")));
  track.width = 1e18;
  EXPECT_THAT([&] { requireSaneTrack(track); }, ThrowsMessage<ModelError>(HasSubstr("the track: width is 1e+18 m")));
  track.observations.resize(kMostEntries + 1);
  EXPECT_THAT([&] { requireSaneTrack(track); }, ThrowsMessage<ModelError>(HasSubstr("there are 10001 poses")));
}

TEST(RequestLimits, WhatIsWithinIsLearned) {
  const double far = kFarthestPosition - kLongestSide;
  for (const Track& track : {doorTrack({far, -far, far}, 0.4, 0.6), doorTrack({0, 0, 1}, kLongestSide, kLongestSide)}) {
    requireSaneTrack(track);
    EXPECT_EQ(fitAllModels(track, ArticulationConfig()).at(0).type, JointType::kRotational);
  }
  EXPECT_FALSE(fitAllModels(doorTrack({far, far, far}, kShortestSide, kShortestSide), ArticulationConfig()).empty());
}

}  // namespace
}  // namespace cabinet_articulation::core
