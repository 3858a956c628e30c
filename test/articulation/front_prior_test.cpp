// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/decision/front_prior.h"

#include <gtest/gtest.h>

#include "articulation/models/prismatic_model.h"
#include "articulation/observations/observation_history.h"
#include "articulation/synthetic_tracks.h"

namespace cabinet_articulation::core {
namespace {

/// Of a front that slides along this direction of its own axes.
double logOdds(const Eigen::Vector3d& direction, double width = 0.4, double height = 0.5) {
  const ArticulationConfig config;
  Track track = syntheticTrack(drawer());
  track.width = width;
  track.height = height;
  const Eigen::Isometry3d start = track.observations.front().rectangle.pose;
  for (std::size_t i = 0; i < track.observations.size(); ++i)
    track.observations[i].rectangle.pose = start * Eigen::Translation3d(0.01 * static_cast<double>(i) * direction.normalized());
  ObservationHistory history(config);
  history.update(track);
  const PoseSequence poses = history.evenlySpaced({}, history.size());
  PrismaticModel model(config);
  EXPECT_TRUE(model.fit(poses, WorkBudget::unlimited()));
  return frontLogOdds(evaluateCandidate(&model, poses, config), track, config);
}

TEST(FrontPrior, DrawersComeOutAlongTheirNormal) {
  EXPECT_GT(logOdds({0, 0, 1}), 3);
  EXPECT_GT(logOdds({0, 0, -1}), 3);
}

TEST(FrontPrior, ASlidingDoorIsNoSurpriseAndASlantedWayIs) {
  const double sliding = logOdds({1, 0, 0}), slanted = logOdds({1, 0, 1});
  EXPECT_GT(sliding, 0);
  EXPECT_LT(sliding, logOdds({0, 0, 1}));
  EXPECT_LT(slanted, -3);
}

TEST(FrontPrior, FewFrontsAreSmall) {
  EXPECT_EQ(logOdds({0, 0, 1}, 0.3, 0.1), logOdds({0, 0, 1}, 0.9, 0.5));
  EXPECT_LT(logOdds({0, 0, 1}, 0.12, 0.1), logOdds({0, 0, 1}, 0.3, 0.1) - 1);
}

/// Observations with these widths, each known to `sigma` [m], and the same height.
Track ofWidths(const std::vector<double>& widths, double sigma) {
  Track track;
  for (const double width : widths) {
    TrackedObservation observation;
    observation.measured.width = width;
    observation.measured.height = 0.3;
    observation.measured_covariance(0, 0) = observation.measured_covariance(1, 1) = sigma * sigma / 4;
    track.observations.push_back(observation);
  }
  return track;
}

TEST(OddsOfOneFront, GrowWithObservationsThatAgree) {
  const double two = oddsOfOneFront(ofWidths({0.4, 0.402}, 0.004), 2, FurniturePrior()),
               three = oddsOfOneFront(ofWidths({0.4, 0.402, 0.4}, 0.004), 3, FurniturePrior());
  EXPECT_GT(two, 8);
  EXPECT_GT(three, two + 5);
  EXPECT_LT(oddsOfOneFront(ofWidths({0.4, 0.402}, 0.04), 2, FurniturePrior()), two - 2) << "sizes that are hardly known say less";
}

TEST(OddsOfOneFront, AreThoseOfTheWorstObservation) {
  EXPECT_LT(oddsOfOneFront(ofWidths({0.4, 0.4, 0.4, 0.5}, 0.01), 4, FurniturePrior()), 0);
  EXPECT_LT(oddsOfOneFront(ofWidths({0.5, 0.4, 0.4, 0.4}, 0.01), 4, FurniturePrior()), 0);
  EXPECT_GT(oddsOfOneFront(ofWidths({0.5, 0.4, 0.4, 0.4}, 0.01), 3, FurniturePrior()), 0) << "an older observation is not asked";
}

TEST(OddsOfOneFront, SayNothingWithoutSizes) {
  EXPECT_EQ(oddsOfOneFront(ofWidths({0.4}, 0.01), 1, FurniturePrior()), std::numeric_limits<double>::infinity());
  Track unknown = ofWidths({0, 0}, 0.01);
  for (TrackedObservation& observation : unknown.observations) observation.measured.height = 0;
  EXPECT_EQ(oddsOfOneFront(unknown, 2, FurniturePrior()), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace cabinet_articulation::core
