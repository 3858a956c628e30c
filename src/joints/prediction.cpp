// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/prediction.h"

#include <cmath>
#include <stdexcept>

#include "articulation/models/model_registry.h"
#include "cabinet_articulation/geometry/limits.h"
#include "geometry/cross_matrix.h"

namespace cabinet_articulation::core {
namespace {

/// Of one observation, from the mean length of the residuals: sqrt(8 / pi) times one direction's sigma.
Matrix6d observationCovariance(const LearnedModel& model) {
  Matrix6d covariance = Matrix6d::Zero();
  covariance.diagonal().head<3>().setConstant(model.position_error * model.position_error * M_PI / 8);
  covariance.diagonal().tail<3>().setConstant(model.orientation_error * model.orientation_error * M_PI / 8);
  return covariance;
}

}  // namespace

UncertainPose predictWithCovariance(const LearnedModel& model, double q) {
  requireJoint(model);
  requireWithin("q", q, limits::kConfiguration);
  const Matrix6d J = modelEntry(model.type).jacobian(model, q);
  return {model.predict(q), J * model.covariance * J.transpose() + observationCovariance(model)};
}

NearestConfiguration nearestConfiguration(const LearnedModel& model, const Eigen::Isometry3d& pose) {
  requireWithin("position", pose.translation(), limits::kFromOrigin);
  if (!pose.linear().allFinite()) throw std::invalid_argument("the orientation is not finite");
  NearestConfiguration nearest;
  nearest.q = model.configuration(pose);
  const Eigen::Isometry3d predicted = model.predict(nearest.q);
  nearest.position_residual = (pose.translation() - predicted.translation()).norm();
  nearest.orientation_residual = angleBetween(pose, predicted);
  return nearest;
}

NearestConfiguration findConfiguration(const LearnedModel& model, const Eigen::Isometry3d& pose) {
  requireJoint(model);
  return nearestConfiguration(model, pose);
}

std::vector<UncertainPose> handlePath(const LearnedModel& model, const Eigen::Isometry3d& T_front_grasp, double q_from,
                                      double q_to, int steps) {
  requireWithin("steps", steps, {2, limits::kMostEntries, "poses"});
  requireWithin("grasp_point", T_front_grasp.translation(), limits::kFromFront);
  if (!T_front_grasp.linear().allFinite()) throw std::invalid_argument("grasp_orientation is not finite");
  requireWithin("q_from", q_from, limits::kConfiguration);
  requireWithin("q_to", q_to, limits::kConfiguration);
  std::vector<UncertainPose> path;
  for (int i = 0; i < steps; ++i) {
    const UncertainPose front = predictWithCovariance(model, q_from + (q_to - q_from) * i / (steps - 1));
    Matrix6d J = Matrix6d::Identity();
    J.topRightCorner<3, 3>() = -crossMatrix(front.pose.linear() * T_front_grasp.translation());
    path.push_back({front.pose * T_front_grasp, J * front.covariance * J.transpose()});
  }
  return path;
}

}  // namespace cabinet_articulation::core
