// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "cabinet_articulation/articulation/articulation_learner.h"

namespace cabinet_articulation::core {

/// How a front moves in truth, and what its detections look like.
struct SyntheticFront {
  JointType type = JointType::kRotational;
  double width = 0.4, height = 0.6;
  double q_start = 0, q_end = 1.2;  ///< rad, or m when it slides
  int poses = 100;
  double period = 1.0 / 15;       ///< [s]
  double noise = 0.003;           ///< [m] of the centre, each frame
  double turn_noise = 0.01;       ///< [rad]
  double drift = 0;               ///< [m] standard deviation of slowly changing noise
  double drift_memory = 0.95;     ///< correlation of the drift with the frame before
  double outliers = 0;            ///< share of poses that are off by decimetres
  bool mixed_quaternions = true;  ///< rotations come from quaternions of either sign
  unsigned seed = 1;
};

inline SyntheticFront door() { return {}; }

inline SyntheticFront drawer() {
  SyntheticFront front;
  front.type = JointType::kPrismatic;
  front.height = 0.125;
  front.q_end = 0.3;
  return front;
}

inline SyntheticFront still() {
  SyntheticFront front;
  front.type = JointType::kRigid;
  return front;
}

inline double probability(const LearnedModel& model, JointType type) {
  return model.probabilities.at(static_cast<std::size_t>(type));
}

inline Eigen::Isometry3d closedPose() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(Eigen::Vector3d(0.1, -0.2, 1.5));
  pose.rotate(Eigen::AngleAxisd(2.9, Eigen::Vector3d(1, 0.15, 0.1).normalized()));
  return pose;
}

/// Doors turn about their edge at -x, which y follows.
inline Eigen::Vector3d trueAxis(const SyntheticFront& front) {
  return front.type == JointType::kPrismatic ? Eigen::Vector3d(closedPose().linear().col(2))
                                             : Eigen::Vector3d(-closedPose().linear().col(1));
}

inline Eigen::Vector3d trueAxisPoint(const SyntheticFront& front) {
  return closedPose() * Eigen::Vector3d(-front.width / 2, 0, 0);
}

inline Eigen::Isometry3d truePose(const SyntheticFront& front, double q) {
  if (front.type == JointType::kRigid) return closedPose();
  if (front.type == JointType::kPrismatic) return Eigen::Translation3d(q * trueAxis(front)) * closedPose();
  const Eigen::Vector3d point = trueAxisPoint(front);
  return Eigen::Translation3d(point) * Eigen::AngleAxisd(q, trueAxis(front)) * Eigen::Translation3d(-point) * closedPose();
}

/// Sizes, ranges and noise as a kitchen has them.
inline SyntheticFront randomFront(unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&random](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  SyntheticFront front = seed % 2 ? door() : drawer();
  front.width = between(0.3, 0.6);
  front.height = front.type == JointType::kPrismatic ? between(0.12, 0.3) : between(0.4, 0.7);
  front.q_end = front.type == JointType::kPrismatic ? between(0.15, 0.35) : between(0.6, 1.5);
  front.noise = between(0.001, 0.004);
  front.turn_noise = between(0.005, 0.02);
  front.seed = seed;
  return front;
}

/// `poseAt`: where the front is at q.
template <class PoseAt>
Track syntheticTrack(const SyntheticFront& front, const PoseAt& poseAt) {
  std::mt19937 random(front.seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const auto vector = [&]() { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  Track track;
  track.id = 7;
  track.width = front.width;
  track.height = front.height;
  Eigen::Vector3d drift = front.drift * vector();
  for (int i = 0; i < front.poses; ++i) {
    const double share = front.poses > 1 ? static_cast<double>(i) / (front.poses - 1) : 0;
    TrackedObservation observation;
    observation.stamp = 10 + i * front.period;
    observation.rectangle.width = front.width;
    observation.rectangle.height = front.height;
    Eigen::Isometry3d pose = poseAt(front.q_start + share * (front.q_end - front.q_start));
    drift = front.drift_memory * drift + std::sqrt(1 - front.drift_memory * front.drift_memory) * front.drift * vector();
    pose.pretranslate(front.noise * vector() + drift);
    const Eigen::Vector3d turn = front.turn_noise * vector();
    pose.rotate(Eigen::AngleAxisd(turn.norm(), turn.norm() > 0 ? Eigen::Vector3d(turn.normalized()) : Eigen::Vector3d::UnitX()));
    if (uniform(random) < front.outliers) {
      pose.pretranslate(0.3 * vector());
      pose.rotate(Eigen::AngleAxisd(normal(random), Eigen::Vector3d::UnitX()));
    }
    if (front.mixed_quaternions) {
      Eigen::Quaterniond q(pose.linear());
      if (uniform(random) < 0.5) q.coeffs() = -q.coeffs();
      pose.linear() = q.toRotationMatrix();
    }
    observation.rectangle.pose = pose;
    track.observations.push_back(observation);
  }
  return track;
}

inline Track syntheticTrack(const SyntheticFront& front) {
  return syntheticTrack(front, [&](double q) { return truePose(front, q); });
}

/// [s] For which a front stands still.
struct Rests {
  double before = 0, half_way = 0, after = 0;
};

inline Track syntheticTrack(const SyntheticFront& front, const Rests& rests) {
  const double half = (front.poses - 1) * front.period / 2, all = rests.before + rests.half_way + rests.after + 2 * half;
  SyntheticFront watched = front;
  watched.q_start = 0;
  watched.q_end = all;
  watched.poses = 1 + static_cast<int>(std::lround(all / front.period));
  return syntheticTrack(watched, [&](double time) {
    const double first = std::clamp(time - rests.before, 0.0, half);
    const double second = std::clamp(time - rests.before - half - rests.half_way, 0.0, half);
    return truePose(front, front.q_start + (front.q_end - front.q_start) * (first + second) / (2 * half));
  });
}

/// The same track from a detector that says how certain it is: standard deviations of positions and orientations.
inline Track reported(Track track, double sigma_position, double sigma_orientation) {
  Eigen::Matrix<double, 6, 1> sigmas;
  sigmas << Eigen::Vector3d::Constant(sigma_position), Eigen::Vector3d::Constant(sigma_orientation);
  for (TrackedObservation& observation : track.observations) observation.covariance = sigmas.cwiseAbs2().asDiagonal();
  return track;
}

/// The only model of one track.
inline LearnedModel learn(const Track& track, const ArticulationConfig& config = {}) {
  return ArticulationLearner(config).process({track}).at(0);
}

/// [rad] between two directions, whatever their sign.
inline double angleBetweenLines(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::asin(std::min(1.0, a.normalized().cross(b.normalized()).norm()));
}

/// [m] mean distance of the predicted from the true front's centre between two true configurations.
inline double predictionError(const SyntheticFront& front, const LearnedModel& model, double q_from, double q_to) {
  constexpr int kSteps = 20;
  double sum = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double q = q_from + (q_to - q_from) * i / kSteps;
    sum += (model.predict(q - front.q_start).translation() - truePose(front, q).translation()).norm();
  }
  return sum / (kSteps + 1);
}

}  // namespace cabinet_articulation::core
