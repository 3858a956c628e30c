// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/prediction.h"

#include <cmath>

#include "cabinet_articulation/joints/request_limits.h"

namespace cabinet_articulation::core {
namespace {

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// How the pose at q changes with the six quantities of LearnedModel::covariance: rows position and rotation vector.
Matrix6d axisJacobian(const LearnedModel& model, double q) {
  Matrix6d J = Matrix6d::Identity();
  if (model.type == JointType::kPrismatic) {
    J.topRightCorner<3, 3>() = -q * crossMatrix(model.axis);
    J.bottomRightCorner<3, 3>().setZero();
  } else if (model.type == JointType::kRotational) {
    // The front is known best in the middle of what was seen; from there it turns by `turn` about the uncertain axis.
    const double middle = (model.q_min + model.q_max) / 2;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(q - middle, model.axis).toRotationMatrix();
    const Eigen::Vector3d arm = model.predict(middle).translation() - model.axis_point;
    const Eigen::Matrix3d rest = Eigen::Matrix3d::Identity() - turn;
    J.topLeftCorner<3, 3>() = rest;
    J.topRightCorner<3, 3>() = turn * crossMatrix(arm) - crossMatrix(turn * arm);
    J.bottomRightCorner<3, 3>() = rest;
  }
  return J;
}

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
  requireOpening(q);
  const Matrix6d J = axisJacobian(model, q);
  return {model.predict(q), J * model.covariance * J.transpose() + observationCovariance(model)};
}

NearestConfiguration findConfiguration(const LearnedModel& model, const Eigen::Isometry3d& pose) {
  requireJoint(model);
  if (!pose.matrix().allFinite()) throw ModelError("the pose is not finite");
  const std::string trouble = positionTrouble(pose.translation());
  if (!trouble.empty()) throw ModelError("the pose's " + trouble);
  NearestConfiguration nearest;
  nearest.q = model.configuration(pose);
  const Eigen::Isometry3d predicted = model.predict(nearest.q);
  nearest.position_residual = (pose.translation() - predicted.translation()).norm();
  nearest.orientation_residual = angleBetween(pose, predicted);
  return nearest;
}

std::vector<UncertainPose> handlePath(const LearnedModel& model, const Eigen::Isometry3d& T_front_grasp, double q_from,
                                      double q_to, int steps) {
  if (steps < 2 || steps > static_cast<int>(kMostEntries))
    throw ModelError("steps is " + std::to_string(steps) + ", expected 2 to " + std::to_string(kMostEntries));
  if (!T_front_grasp.matrix().allFinite()) throw ModelError("the grasp is not finite");
  const std::string trouble = positionTrouble(T_front_grasp.translation(), kFarthestGrasp);
  if (!trouble.empty()) throw ModelError("the grasp's " + trouble);
  requireOpening(q_from);
  requireOpening(q_to);
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
