// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/models/rigid_model.h"

#include <Eigen/Cholesky>
#include <vector>

#include "geometry/median.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kRounds = 8;
constexpr double kTolerance = 1e-6;  ///< [m], [rad]

/// Coordinate-wise median: a start that gross outliers cannot move.
Eigen::Vector3d medianPosition(const PoseSamples& samples) {
  Eigen::Vector3d position;
  std::vector<double> values(samples.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < samples.size(); ++i) values[i] = samples.positions[i][axis];
    position[axis] = median(values);
  }
  return position;
}

}  // namespace

bool RigidModel::fit(const PoseSequence& track, const WorkBudget&) {
  if (track.size() == 0) return false;
  const PoseSamples samples(track);
  const bool weighted = !samples.position_weights.empty();
  Eigen::Vector3d position = medianPosition(samples);
  Eigen::Quaterniond orientation = samples.orientations[samples.size() / 2];
  const double nu = config_.degrees_of_freedom;
  const double sigma_position = sigmaPosition(track, config_), sigma_orientation = sigmaOrientation(track, config_);
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix3d information = 1e-9 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d sum = 1e-9 * position;
    Eigen::Vector4d orientation_sum = Eigen::Vector4d::Zero();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      Eigen::Matrix3d weight = Eigen::Matrix3d::Identity();
      if (weighted) weight = samples.position_weights[i] * samples.position_weights[i];
      const Eigen::Vector3d away = samples.positions[i] - position;
      const double square = away.dot(weight * away) / (sigma_position * sigma_position);
      weight *= (nu + 3) / (nu + square);
      information += weight;
      sum += weight * samples.positions[i];
      Eigen::Vector4d q = samples.orientations[i].coeffs();
      if (q.dot(orientation.coeffs()) < 0) q = -q;
      const double angle = samples.orientations[i].angularDistance(orientation) / sigma_orientation;
      orientation_sum += q * (nu + 3) / (nu + angle * angle);
    }
    const Eigen::Vector3d last = position;
    const Eigen::Quaterniond last_orientation = orientation;
    position = information.ldlt().solve(sum);
    orientation.coeffs() = orientation_sum.normalized();
    if ((position - last).norm() < kTolerance && orientation.angularDistance(last_orientation) < kTolerance) break;
  }
  pose_.translation() = position;
  pose_.linear() = orientation.toRotationMatrix();
  return true;
}

Matrix6d RigidModel::covariance(const PoseSequence& track, const Eigen::Vector3d& p, double correlation) const {
  const ModelResiduals all = residuals(track);
  const double n = static_cast<double>(track.size());
  double position = 0, orientation = 0;
  for (std::size_t i = 0; i < track.size(); ++i) {
    position += all.position[i].squaredNorm() / 3;
    orientation += all.orientation[i].squaredNorm() / 3;
  }
  const double inflation = covarianceInflation(correlation) / n;
  const double floor = config_.sigma_position_floor * config_.sigma_position_floor;
  return pointCovariance(inflation * (position / n + floor), inflation * orientation / n, p - pose_.translation());
}

std::vector<ModelParam> RigidModel::parameters() const {
  std::vector<ModelParam> params;
  appendParam("rigid_position", Eigen::Vector3d(pose_.translation()), &params);
  appendParam("rigid_orientation", Eigen::Quaterniond(pose_.linear()), &params);
  return params;
}

Eigen::Isometry3d RigidModel::predictLearned(const LearnedModel& model, double) { return model.origin; }

double RigidModel::configurationOfLearned(const LearnedModel&, const Eigen::Isometry3d&) { return 0; }

Matrix6d RigidModel::jacobianOfLearned(const LearnedModel&, double) { return Matrix6d::Identity(); }

LearnedModel RigidModel::example() { return closedExample(JointType::kRigid); }

}  // namespace cabinet_articulation::core
