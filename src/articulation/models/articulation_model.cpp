// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/models/articulation_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "articulation/paths/arc.h"

namespace cabinet_articulation::core {
namespace {

/// Whether value i is farther than `margin` from both neighbours (at an end: from the next two), which agree: a false
/// detection rather than motion.
bool isolated(const std::vector<double>& values, std::size_t i, double margin) {
  const std::size_t last = values.size() - 1;
  const double one = values[i == 0 ? 1 : i - 1];
  const double other = values[i == 0 ? 2 : i == last ? last - 2 : i + 1];
  return std::min(std::abs(values[i] - one), std::abs(values[i] - other)) > margin + 3 * std::abs(one - other);
}

/// The range of q over the poses near the model. An extreme that only a single pose in between others saw is not believed.
std::pair<double, double> observedRange(const ModelResiduals& residuals, double limit, double metres_per_q) {
  const std::vector<double>& q = residuals.q;
  std::vector<double> near;
  for (std::size_t i = 0; i < q.size(); ++i)
    if (residuals.position[i].norm() <= limit) near.push_back(q[i]);
  if (near.empty()) near = q;
  if (near.empty()) return {0, 0};
  double min = std::numeric_limits<double>::infinity(), max = -min;
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (near.size() > 2 && isolated(near, i, limit / metres_per_q)) continue;
    min = std::min(min, near[i]);
    max = std::max(max, near[i]);
  }
  return min <= max ? std::make_pair(min, max) : std::make_pair(near.front(), near.front());
}

/// By which noise within the plane may be larger than it is said to be: an edge that something hides moves with that.
constexpr double kEdgeCaution = 2;

/// Sum of costs; the cost of a pose that is an exception among its neighbours is theirs.
double sumWithoutExceptions(const std::vector<double>& costs) {
  double sum = 0;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    const double before = costs[i == 0 ? 0 : i - 1], after = costs[std::min(i + 1, costs.size() - 1)];
    sum += std::min(std::max(std::min(before, after), costs[i]), std::max(before, after));
  }
  return sum;
}

/// Which share of a step along the path was observed, for pose i. `scale`: of the weights, for it to be 1.
double observedAlongPath(const ArticulationModel& model, const PoseSequence& track, std::size_t i, double q, double scale) {
  if (track.position_weights.empty()) return 1;
  constexpr double kStep = 1e-4;
  const Eigen::Vector3d step = model.predict(q + kStep).translation() - model.predict(q - kStep).translation();
  const double observed = scale * (track.position_weights[i] * step).norm();
  return step.norm() > 0 ? std::min(1.0, observed / step.norm()) : 1;
}

/// What the freedom of q costs each pose beyond its noise along the path, which is `spread` wide. It is the logarithm of the
/// noise's density over that of q, as the other poses show it. Eq. (6) takes q as uniform; then a front that stands open for
/// longer than it took to open would rather not have moved.
std::vector<double> costsOfPlaces(const ModelResiduals& residuals, double spread) {
  const auto steps = static_cast<std::size_t>(std::clamp(std::ceil(residuals.path / spread), 1.0, 1000.0));
  const double range = residuals.q_max - residuals.q_min;
  std::vector<std::size_t> counts(steps, 0), places;
  for (const double q : residuals.q) {
    const double share = range > 0 ? std::clamp((q - residuals.q_min) / range, 0.0, 1.0) : 0;
    places.push_back(std::min(steps - 1, static_cast<std::size_t>(share * static_cast<double>(steps))));
    ++counts[places.back()];
  }
  std::vector<double> costs;
  const auto others = static_cast<double>(places.size() + steps - 1);
  for (const std::size_t place : places) costs.push_back(std::log(others / static_cast<double>(counts[place])));
  return costs;
}

}  // namespace

double ArticulationModel::pathLength(double q_min, double q_max, const Eigen::Vector3d& point) const {
  constexpr int kSteps = 8;  // an arc of a quarter turn is then too short by 0.2 %
  double length = 0;
  Eigen::Vector3d last = predict(q_min) * point;
  for (int i = 1; i <= kSteps; ++i) {
    const Eigen::Vector3d next = predict(q_min + (q_max - q_min) * i / kSteps) * point;
    length += (next - last).norm();
    last = next;
  }
  return length;
}

std::vector<double> ArticulationModel::configurations(const PoseSequence& track) const {
  std::vector<double> q;
  for (const Eigen::Isometry3d& pose : track.poses) q.push_back(configuration(pose));
  return q;
}

ModelResiduals ArticulationModel::residuals(const PoseSequence& track) const {
  ModelResiduals residuals;
  residuals.q = configurations(track);
  const bool weighted = track.has_orientation && !track.position_weights.empty();
  const double sigma_position = sigmaPosition(track, config_), sigma_orientation = sigmaOrientation(track, config_);
  for (std::size_t i = 0; i < track.size(); ++i) {
    const Eigen::Isometry3d predicted = predict(residuals.q[i]);
    Eigen::Vector3d position = track.poses[i].translation() - predicted.translation();
    Eigen::Vector3d orientation = Eigen::Vector3d::Zero();
    if (track.has_orientation)
      orientation = rotationVector(Eigen::Quaterniond(track.poses[i].linear() * predicted.linear().transpose()));
    double displaced = position.norm() / sigma_position, turned = orientation.norm() / sigma_orientation;
    if (weighted) {
      position = track.position_weights[i] * position;
      orientation = track.orientation_weights[i] * orientation;
      displaced = std::min(displaced, position.norm() / config_.sigma_plane);
      turned = std::min(turned, orientation.norm() / sigma_orientation);
    }
    residuals.displaced.push_back(displaced);
    residuals.turned.push_back(turned);
    residuals.position.push_back(position);
    residuals.orientation.push_back(orientation);
  }
  constexpr double kStep = 1e-3;
  const double speed = (predict(kStep).translation() - predict(0).translation()).norm() / kStep;
  std::tie(residuals.q_min, residuals.q_max) = observedRange(residuals, outlierDistance(track, config_), std::max(speed, 1e-6));
  if (moves() && track.size() > 0) {
    // Successive poses tell one turn from the next: the place within a turn is what is free.
    const double once = traits().turns ? std::min(residuals.q_max, residuals.q_min + 2 * M_PI) : residuals.q_max;
    residuals.path = pathLength(residuals.q_min, once, Eigen::Vector3d::Zero());
    residuals.freedom = costOfFreedom(track, residuals);
  }
  return residuals;
}

double ArticulationModel::logLikelihood(const PoseSequence& track, const ModelResiduals& residuals, double caution) const {
  const double spread = std::sqrt(2 * M_PI) * sigmaPosition(track, config_);  // of one direction's noise
  const double sigma_orientation = caution * sigmaOrientation(track, config_);
  const double sigma_plane = kEdgeCaution * config_.sigma_plane;
  std::vector<double> costs;
  for (std::size_t i = 0; i < residuals.q.size(); ++i) {
    // Eq. (9), with the factor 1/2 of a Gaussian and a sigma each for position and orientation.
    const double displaced = std::min(residuals.displaced[i], residuals.position[i].norm() / sigma_plane);
    double cost = displaced * displaced / 2;
    if (track.has_orientation) cost += residuals.orientation[i].squaredNorm() / (2 * sigma_orientation * sigma_orientation);
    costs.push_back(std::min(cost, kGrossSigmas * kGrossSigmas / 2));
  }
  const double sum = -3 * std::log(spread) * static_cast<double>(costs.size()) - sumWithoutExceptions(costs);  // Eq. (10)
  return sum - residuals.freedom;
}

double ArticulationModel::covarianceInflation(double correlation) const {
  return config_.covariance_factor * (1 + correlation) / (1 - correlation);
}

double ArticulationModel::costOfFreedom(const PoseSequence& track, const ModelResiduals& residuals) const {
  const double spread = std::sqrt(2 * M_PI) * sigmaPosition(track, config_);  // of the noise along the path
  const double scale = config_.sigma_position / (kEdgeCaution * config_.sigma_plane);
  // Eq. (6): the integral over q of a density 1 / path takes the noise along the path out and puts 1 / path in.
  const double uniform = std::log(std::max(residuals.path, 1e-9) / spread);
  const std::vector<double> places = costsOfPlaces(residuals, spread);
  double anywhere = 0, as_seen = 0;
  for (std::size_t i = 0; i < residuals.q.size(); ++i) {
    const double unseen = std::log(std::max(1e-9, observedAlongPath(*this, track, i, residuals.q[i], scale)));
    anywhere += std::max(0.0, uniform + unseen);
    as_seen += std::max(0.0, places[i] + unseen);
  }
  return std::min(anywhere, as_seen);
}

LearnedModel closedExample(JointType type) {
  LearnedModel model;
  model.type = type;
  model.moved = true;
  model.width = 0.4;
  model.height = 0.6;
  model.origin.translate(Eigen::Vector3d(0.1, -0.2, 1.5));
  model.origin.rotate(Eigen::AngleAxisd(2.9, Eigen::Vector3d(1, 0.15, 0.1).normalized()));
  return model;
}

Matrix6d pointCovariance(double position_variance, double orientation_variance, const Eigen::Vector3d& lever) {
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  Matrix6d covariance = Matrix6d::Zero();
  covariance.topLeftCorner<3, 3>() =
      position_variance * identity + orientation_variance * (lever.squaredNorm() * identity - lever * lever.transpose());
  covariance.bottomRightCorner<3, 3>() = orientation_variance * identity;
  return covariance;
}

void appendParam(const std::string& name, const Eigen::Vector3d& value, std::vector<ModelParam>* params) {
  params->push_back({name + ".x", value.x(), ModelParam::kParam});
  params->push_back({name + ".y", value.y(), ModelParam::kParam});
  params->push_back({name + ".z", value.z(), ModelParam::kParam});
}

void appendParam(const std::string& name, const Eigen::Quaterniond& value, std::vector<ModelParam>* params) {
  appendParam(name, Eigen::Vector3d(value.vec()), params);
  params->push_back({name + ".w", value.w(), ModelParam::kParam});
}

}  // namespace cabinet_articulation::core
