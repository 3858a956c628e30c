// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/models/nonparametric_model.h"

#include <gtest/gtest.h>

#include <limits>

#include "articulation/observations/observation_history.h"
#include "articulation/synthetic_tracks.h"

namespace cabinet_articulation::core {
namespace {

/// A garage door's front: its lower edge goes up while its upper edge goes back, by `share` of the whole way.
Eigen::Isometry3d garageDoor(double share) {
  constexpr double kHeight = 0.6;
  const double angle = share * M_PI / 2;
  // The front in its plane of motion: the upper edge at (0, sin) along z, the lower edge at (cos, 0) along y.
  const Eigen::Vector3d center(0, kHeight / 2 * (1 - std::cos(angle)), -kHeight / 2 * std::sin(angle));
  return closedPose() * Eigen::Translation3d(center) * Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitX()) *
         Eigen::Translation3d(0, 0.1 * share, 0);
}

Track garageTrack(double noise, unsigned seed, double from = 0, double to = 1, int poses = 100) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto vector = [&]() { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  Track track;
  track.id = 4;
  track.width = 0.8;
  track.height = 0.6;
  for (int i = 0; i < poses; ++i) {
    TrackedObservation observation;
    observation.stamp = i / 15.0;
    observation.rectangle = {garageDoor(from + (to - from) * i / (poses - 1)), track.width, track.height};
    observation.rectangle.pose.pretranslate(noise * vector());
    observation.rectangle.pose.rotate(Eigen::AngleAxisd(3 * noise * normal(random), vector().normalized()));
    track.observations.push_back(observation);
  }
  return track;
}

/// Front that slides out and then turns sideways by an S: no line, no circle.
Track slidingAndTurningTrack(double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto vector = [&]() { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  Track track;
  track.width = 0.5;
  track.height = 0.5;
  for (int i = 0; i < 120; ++i) {
    const double s = 0.9 * i / 119;
    TrackedObservation observation;
    observation.stamp = i / 15.0;
    Eigen::Isometry3d pose = closedPose() * Eigen::Translation3d(s, 0, 0.12 * std::sin(7 * s)) *
                             Eigen::AngleAxisd(0.6 * std::sin(3 * s), Eigen::Vector3d::UnitY());
    pose.pretranslate(noise * vector());
    observation.rectangle = {pose, track.width, track.height};
    track.observations.push_back(observation);
  }
  return track;
}

TEST(NonparametricModel, IsWhatSlidesAndTurns) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Track track = slidingAndTurningTrack(0.004, seed);
    const LearnedModel model = learn(track);
    EXPECT_EQ(model.type, JointType::kNonparametric) << seed;
    EXPECT_TRUE(model.moved);
    EXPECT_TRUE(model.explained);
    EXPECT_GT(model.probabilities.at(3), 0.95) << seed;
    // The curve averages noise of 4 mm; configurations of single poses have it along the way.
    const Track truth = slidingAndTurningTrack(0, 1);
    for (const TrackedObservation& observation : truth.observations) {
      const Eigen::Isometry3d& pose = observation.rectangle.pose;
      const Eigen::Isometry3d predicted = model.predict(model.configuration(pose));
      EXPECT_LT((predicted.translation() - pose.translation()).norm(), 0.006) << seed;
      EXPECT_LT(angleBetween(predicted, pose), 0.04) << seed;
    }
  }
}

TEST(NonparametricModel, IsAFlapThatIsLiftedByArmsAndDoesNotTurn) {
  SyntheticFront arms = door();  // turns by 80 degrees at 40 cm from its hinge
  arms.width = 0.8;
  arms.q_end = 1.4;
  Track track = syntheticTrack(arms);
  for (TrackedObservation& observation : track.observations) observation.rectangle.pose.linear() = closedPose().linear();
  for (const Track& seen : {track, reported(track, 0.003, 0.01)}) {
    const LearnedModel model = learn(seen);
    EXPECT_EQ(model.type, JointType::kNonparametric) << "no line, and no hinge either";
    EXPECT_LT(model.position_error, 0.01);
  }
}

TEST(NonparametricModel, IsWhatSlidesAndThenTurns) {
  SyntheticFront front = still();
  front.type = JointType::kRotational;
  front.q_end = 0;
  Track track = syntheticTrack(front);
  for (std::size_t i = 0; i < track.observations.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(track.observations.size());
    const Eigen::Isometry3d turned = truePose(front, std::max(0.0, 3 * share - 1.5)) * closedPose().inverse();
    const double slide = 0.3 * std::min(1.0, 2 * share);
    Eigen::Isometry3d& pose = track.observations[i].rectangle.pose;
    pose = Eigen::Translation3d(slide * closedPose().linear().col(2)) * turned * pose;
  }
  const LearnedModel model = learn(reported(track, 0.003, 0.01));
  EXPECT_EQ(model.type, JointType::kNonparametric);
  EXPECT_LT(model.position_error, 0.01);
}

TEST(NonparametricModel, GoesOnBeyondWhatWasSeen) {
  const LearnedModel model = [] {
    NonparametricModel free((ArticulationConfig()));
    ObservationHistory poses((ArticulationConfig()));
    poses.update(garageTrack(0.002, 3, 0, 0.9));
    EXPECT_TRUE(free.fit(poses.evenlySpaced({}, 1000), WorkBudget::unlimited()));
    LearnedModel learned;
    learned.type = JointType::kNonparametric;
    const ModelResiduals residuals = free.residuals(poses.evenlySpaced({}, 1000));
    learned.q_min = residuals.q_min;
    learned.q_max = residuals.q_max;
    learned.curve = free.curve(residuals.q_min, residuals.q_max);
    return learned;
  }();
  // 0.9 to 1: 6 cm and 9 degrees further, on a bend of 30 cm radius that a straight line leaves by 6 mm.
  const Eigen::Isometry3d beyond = garageDoor(1);
  const Eigen::Isometry3d predicted = model.predict(model.configuration(beyond));
  EXPECT_LT((predicted.translation() - beyond.translation()).norm(), 0.012);
  EXPECT_LT(angleBetween(predicted, beyond), 0.06);
  EXPECT_GT(model.configuration(beyond), model.q_max);
}

TEST(NonparametricModel, IsNotAskedWhereAJointExplainsTheMotion) {
  SyntheticFront front;
  front.outliers = 0.1;
  for (front.seed = 1; front.seed <= 5; ++front.seed)
    EXPECT_EQ(learn(syntheticTrack(front)).probabilities.at(3), 0) << front.seed;
}

TEST(NonparametricModel, IsNoCandidateWhenDisabled) {
  ArticulationConfig config;
  config.joint_types = "rigid prismatic rotational";
  for (const LearnedModel& model : fitAllModels(slidingAndTurningTrack(0.004, 1), config)) {
    EXPECT_NE(model.type, JointType::kNonparametric);
    EXPECT_EQ(model.probabilities.at(3), 0);
  }
}

TEST(PoseCurve, ConfigurationIsTheInverseOfPrediction) {
  const LearnedModel model = learn(slidingAndTurningTrack(0.002, 1));
  ASSERT_EQ(model.type, JointType::kNonparametric);
  for (int i = -2; i <= 12; ++i) {
    const double q = model.q_min + (model.q_max - model.q_min) * i / 10;
    EXPECT_NEAR(model.configuration(model.predict(q)), q, 1e-9) << i;
  }
}

TEST(PoseCurve, RestsWhereItsWayIsTooShortToDivideBy) {
  LearnedModel model = learn(slidingAndTurningTrack(0.002, 1));
  ASSERT_EQ(model.type, JointType::kNonparametric);
  model.q_min = 0;
  model.q_max = std::numeric_limits<double>::denorm_min();
  EXPECT_TRUE(model.predict(0.1).isApprox(model.origin));
  EXPECT_EQ(model.configuration(model.curve.back()), 0);
}

}  // namespace
}  // namespace cabinet_articulation::core
