// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/observations/observation_covariance.h"

#include <gtest/gtest.h>

#include "articulation/synthetic_tracks.h"
#include "geometry/degrees.h"

namespace cabinet_articulation::core {
namespace {

/// What an observation says of itself, the same along both sides of the front.
Matrix6d reported(double along_sides) {
  Eigen::Matrix<double, 6, 1> sigmas;
  sigmas << along_sides, along_sides, along_sides, 0.003, 0.003, 0.003;
  return sigmas.cwiseAbs2().asDiagonal();
}

TEST(ObservationNoise, WhatIsSeenWellWeighsAsMuchAsItsCovarianceSays) {
  TrackedObservation observation = syntheticTrack(drawer()).observations.front();
  observation.covariance = reported(1e-5);
  const Matrix6d total = totalCovariance(observation, {}), weighing = weighingCovariance(observation, {});
  EXPECT_TRUE(weighing.isApprox(total, 1e-4));
}

TEST(ObservationNoise, DoubtfulEdgesWeighLessInProportion) {
  TrackedObservation observation = syntheticTrack(drawer()).observations.front();
  const Eigen::Vector3d side = observation.rectangle.pose.linear().col(1);
  const Eigen::Vector3d normal = observation.rectangle.pose.linear().col(2);
  const auto variance = [&](double sigma, const Eigen::Vector3d& direction) {
    observation.covariance = reported(sigma);
    return direction.dot(weighingCovariance(observation, {}).topLeftCorner<3, 3>() * direction);
  };
  EXPECT_NEAR(variance(0.02, side) / variance(0.01, side), 4, 0.5);
  // Planes do not lie on neighbours.
  EXPECT_NEAR(variance(0.02, normal) - variance(0.01, normal), 3e-4, 1e-9);
}

TEST(ObservationNoise, AFrontThatHasJustOpenedDoesNotTurnTheAxis) {
  SyntheticFront front = drawer();
  front.noise = 0.001;
  front.turn_noise = 0.003;
  Track track = syntheticTrack(front);
  for (std::size_t i = 0; i < track.observations.size(); ++i) {
    TrackedObservation& observation = track.observations[i];
    const bool just_opened = i < 10;
    observation.covariance = reported(just_opened ? 0.007 : 0.0015);
    // The upper edge is the next front's.
    if (just_opened) observation.rectangle.pose.translate(Eigen::Vector3d(0, 0.014, 0));
  }
  EXPECT_LT(angleBetweenLines(learn(track).axis, trueAxis(front)), 0.5 * kDegree);
}

}  // namespace
}  // namespace cabinet_articulation::core
