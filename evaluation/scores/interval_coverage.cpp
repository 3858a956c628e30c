// SPDX-License-Identifier: BSD-3-Clause
#include "scores/interval_coverage.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "geometry/degrees.h"
#include "scores/learning_curve.h"

namespace cabinet_articulation::core::evaluation {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kNormal95 = 1.95996;  // two-sided, standard normal
constexpr double kChi95 = 5.99146;     // chi-square, 2 degrees of freedom

Vector3d gaussian(double sigma, cv::RNG* random) {
  const double x = random->gaussian(sigma), y = random->gaussian(sigma), z = random->gaussian(sigma);
  return {x, y, z};
}

Vector3d randomDirection(cv::RNG* random) { return gaussian(1, random).normalized(); }

Isometry3d turned(const Isometry3d& pose, const Vector3d& rotation) {
  Isometry3d result = pose;
  if (rotation.norm() > 0) result.linear() = Eigen::AngleAxisd(rotation.norm(), rotation.normalized()) * pose.linear();
  return result;
}

/// Slow noise: each value keeps `memory` of the one before.
class Drift {
 public:
  Drift(double sigma, double memory, cv::RNG* random) : sigma_(sigma), memory_(memory), value_(gaussian(sigma, random)) {}

  Vector3d next(cv::RNG* random) {
    value_ = memory_ * value_ + gaussian(std::sqrt(1 - memory_ * memory_) * sigma_, random);
    return value_;
  }

 private:
  double sigma_, memory_;
  Vector3d value_;
};

Track noisyTrack(const LearnedModel& truth, double q_end, int count, cv::RNG* random) {
  const double memory = random->uniform(0.7, 0.95);
  const double white = random->uniform(0.001, 0.003), white_turn = random->uniform(0.2, 0.6) * kDegree;
  Drift drift(random->uniform(0.001, 0.004), memory, random), turn(random->uniform(0.3, 1.0) * kDegree, memory, random);
  Track track;
  track.width = truth.width;
  track.height = truth.height;
  for (int i = 0; i < count; ++i) {
    TrackedObservation observation;
    observation.stamp = i / 15.0;
    observation.rectangle = {turned(truth.predict(q_end * i / (count - 1)), turn.next(random) + gaussian(white_turn, random)),
                             truth.width, truth.height};
    observation.rectangle.pose.pretranslate(drift.next(random) + gaussian(white, random));
    observation.measured = observation.rectangle;
    track.observations.push_back(observation);
  }
  return track;
}

}  // namespace

AxisEstimate AxisEstimate::of(const LearnedModel& model) {
  return {model.type, model.axis, model.axis_point, model.radius, model.covariance, model.origin.translation()};
}

IntervalCheck checkIntervals(const AxisEstimate& a, const AxisEstimate& b) {
  IntervalCheck check;
  // Two directions across the axis in which it can tilt.
  Eigen::Matrix<double, 3, 2> across;
  across.col(0) = a.axis.unitOrthogonal();
  across.col(1) = a.axis.cross(across.col(0));
  const Vector3d rotation = a.axis.cross(a.axis.dot(b.axis) < 0 ? Vector3d(-b.axis) : b.axis);
  const Eigen::Vector2d tilt = across.transpose() * rotation;
  const Matrix6d sum = a.covariance + b.covariance;
  const Eigen::Matrix2d variance = across.transpose() * sum.bottomRightCorner<3, 3>() * across;
  check.axis = std::sqrt(tilt.dot(variance.inverse() * tilt) / kChi95);
  if (a.type != JointType::kRotational) return check;
  const auto radial = [](const AxisEstimate& e) {
    const Vector3d u = (e.center - e.axis_point).normalized();
    return u.dot(e.covariance.topLeftCorner<3, 3>() * u);
  };
  check.radius = std::abs(a.radius - b.radius) / (kNormal95 * std::sqrt(radial(a) + radial(b)));
  return check;
}

NoisyFront simulateNoisyFront(JointType type, int seed, std::optional<int> poses) {
  cv::RNG random(static_cast<std::uint64_t>(seed) + 1);
  for (int i = 0; i < 10; ++i) random.next();  // neighbouring seeds start alike
  LearnedModel truth;
  truth.type = type;
  truth.width = random.uniform(0.3, 0.6);
  truth.height = random.uniform(0.12, 0.7);
  truth.origin = turned(Isometry3d::Identity(), random.uniform(0.0, CV_PI) * randomDirection(&random));
  truth.origin.pretranslate(Vector3d(0, 0, 1.5) + gaussian(0.2, &random));
  double q_end = random.uniform(0.2, 0.4);
  truth.axis = truth.origin.linear().col(2);
  if (type == JointType::kRotational) {
    q_end = random.uniform(0.6, 1.5);
    truth.axis = -truth.origin.linear().col(1);
    truth.axis_point = truth.origin * Vector3d(-truth.width / 2, 0, 0);
    truth.radius = truth.width / 2;
  }
  const int count = random.uniform(40, 150);
  return {noisyTrack(truth, q_end, poses.value_or(count), &random), AxisEstimate::of(truth)};
}

std::optional<IntervalCheck> compareHalves(const TrackSource& source) {
  constexpr int kBlocks = 10;
  const int size = static_cast<int>(source.reference().size());
  std::vector<LearnedModel> halves;
  for (const int half : {0, 1}) {
    std::vector<int> picked;
    for (int i = 0; i < size; ++i)
      if (i * kBlocks / size % 2 == half) picked.push_back(i);
    if (const auto model = observeAll(source, picked).model) halves.push_back(*model);
  }
  if (halves.size() < 2 || source.facts().type == JointType::kRigid) return std::nullopt;
  if (!isRight(halves[0], source.facts()) || !isRight(halves[1], source.facts())) return std::nullopt;
  return checkIntervals(AxisEstimate::of(halves[0]), AxisEstimate::of(halves[1]));
}

}  // namespace cabinet_articulation::core::evaluation
