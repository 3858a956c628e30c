// SPDX-License-Identifier: BSD-3-Clause
// Models that are learned pose by pose against those that are learned from all poses at once.
#include <gtest/gtest.h>

#include <string>

#include "articulation/fitting/arc_fit.h"
#include "articulation/synthetic_tracks.h"

namespace cabinet_articulation::core {
namespace {

/// How far an update may be from a fresh fit, in its own standard deviations. The first is once the front has been seen, the
/// second while it opens, when steps follow the poses.
constexpr double kTolerance = 0.25, kToleranceInMotion = 0.75;

/// What real logs are like: the hand rests at either end, slips, and some detections are false.
Track realisticTrack(SyntheticFront front) {
  front.drift = 0.003;
  front.outliers = 0.03;
  Track track;
  const double q_end = front.q_end;
  for (int part = 0; part < 3; ++part) {
    front.q_start = part == 2 ? q_end : 0;
    front.q_end = part == 0 ? 0 : q_end;
    front.poses = part == 1 ? 100 : 50;
    front.seed += 100;
    for (TrackedObservation observation : syntheticTrack(front).observations) {
      observation.stamp = 10 + front.period * static_cast<double>(track.observations.size());
      track.observations.push_back(observation);
    }
  }
  track.id = 7;
  track.width = front.width;
  track.height = front.height;
  return track;
}

std::vector<Track> tracks(unsigned seed) {
  std::vector<Track> all;
  for (SyntheticFront front : {door(), drawer(), still()}) {
    front.seed = seed;
    all.push_back(realisticTrack(front));
    front.poses = 250;
    all.push_back(syntheticTrack(front));
  }
  return all;
}

Track prefix(const Track& track, std::size_t poses) {
  Track part = track;
  part.observations.resize(poses);
  return part;
}

/// Largest difference of the joint's place and direction in standard deviations; those below rounding count as it.
double difference(const LearnedModel& a, const LearnedModel& b) {
  Eigen::Matrix<double, 6, 1> away;
  const bool turns = a.type == JointType::kRotational;
  away << (turns ? Eigen::Vector3d(a.axis_point - b.axis_point)
                 : Eigen::Vector3d(a.origin.translation() - b.origin.translation())),
      a.axis - b.axis;
  const Eigen::Matrix<double, 6, 1> sigmas = b.covariance.diagonal().cwiseSqrt().cwiseMax(1e-4);
  return away.cwiseQuotient(sigmas).cwiseAbs().maxCoeff();
}

TEST(IncrementalFit, AgreesWithAFreshOne) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    for (const Track& track : tracks(seed)) {
      ArticulationLearner learner({});
      for (std::size_t n = 1; n <= track.observations.size(); ++n) {
        const LearnedModel model = learner.process({prefix(track, n)}).at(0);
        // Before, half of the poses are at rest, and fresh fits themselves may end in different optima.
        if (n % 10 != 0 || n < 150) continue;
        const LearnedModel fresh = learn(prefix(track, n));
        const std::string what = std::to_string(seed) + ", " + std::to_string(n) + " poses of " + std::to_string(int(fresh.type));
        EXPECT_EQ(model.type, fresh.type) << what;
        EXPECT_EQ(model.moved, fresh.moved) << what;
        EXPECT_LT(difference(model, fresh), n == track.observations.size() ? kTolerance : kToleranceInMotion) << what;
      }
    }
  }
}

TEST(IncrementalFit, CirclesStayWithinTheirLimits) {
  const ArticulationConfig config;
  PoseSequence track;
  Arc line;
  for (int i = 0; i < 10; ++i) {
    track.poses.push_back(line.pose(0.03 * i));
    track.stamps.push_back(i);
  }
  for (const int steps : {0, 1, 5}) {
    const ArcFit fit = fitArc(PoseSamples(track), PathShape::kCircle, {line, 0.001, 0.1}, FitEffort::continued(steps), config);
    EXPECT_GE(std::abs(fit.arc.curvature), 1 / config.radius_max) << steps;
  }
}

TEST(IncrementalFit, AHistoryThatWasPlacedAnewIsLearnedAnew) {
  for (const Track& track : tracks(1)) {
    ArticulationLearner learner({});
    for (std::size_t n = 1; n <= 150; ++n) learner.process({prefix(track, n)});
    Track anew = prefix(track, 151);
    ++anew.revision;
    for (TrackedObservation& observation : anew.observations) observation.rectangle.pose.translate(Eigen::Vector3d(0.02, 0, 0));
    const LearnedModel model = learner.process({anew}).at(0), fresh = learn(anew);
    EXPECT_EQ(model.probabilities, fresh.probabilities);
    EXPECT_TRUE(model.origin.isApprox(fresh.origin, 0));
    EXPECT_EQ(model.axis, fresh.axis);
    EXPECT_EQ(model.covariance, fresh.covariance);
  }
}

TEST(IncrementalFit, TheSameUpdatesGiveTheSameAnswer) {
  for (const Track& track : tracks(2)) {
    ArticulationLearner one({}), other({});
    for (std::size_t n = 1; n <= track.observations.size(); ++n) {
      const LearnedModel a = one.process({prefix(track, n)}).at(0), b = other.process({prefix(track, n)}).at(0);
      ASSERT_EQ(a.probabilities, b.probabilities) << n;
      ASSERT_EQ(a.axis, b.axis) << n;
      ASSERT_EQ(a.covariance, b.covariance) << n;
    }
  }
}

}  // namespace
}  // namespace cabinet_articulation::core
