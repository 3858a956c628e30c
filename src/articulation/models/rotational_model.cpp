// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/models/rotational_model.h"

#include <algorithm>
#include <cmath>

#include "geometry/cross_matrix.h"
#include "geometry/turn_between.h"

namespace cabinet_articulation::core {

double RotationalModel::logPrior() const {
  const double wider = std::max(0.0, std::log(arc_.radius() / config_.prior.door_radius));
  return -0.5 * std::pow(wider / config_.prior.door_radius_spread, 2);
}

JointGeometry RotationalModel::geometry() const { return {arc_.axis(), arc_.center(), arc_.radius(), 0}; }

Matrix6d RotationalModel::covariance(const PoseSequence& track, const Eigen::Vector3d& p, double correlation) const {
  const Eigen::Vector3d to_center = arc_.center() - arc_.middle;
  const double height = arc_.axis().dot(p - arc_.center());
  Eigen::Matrix<double, 6, 9> jacobian = Eigen::Matrix<double, 6, 9>::Zero();
  jacobian.block<3, 2>(0, 0) = arc_.frame.rightCols<2>();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d turn = arc_.frame.col(i);
    jacobian.block<3, 1>(0, 2 + i) = turn.cross(to_center + height * arc_.axis());
    if (i < 2) jacobian.block<3, 1>(3, 2 + i) = turn;  // a turn about the axis itself changes nothing
  }
  jacobian.block<3, 1>(0, 5) = -to_center / arc_.curvature;
  return jacobian * parameterCovariance(track, correlation) * jacobian.transpose();
}

std::vector<ModelParam> RotationalModel::parameters() const {
  // The original's forward map is T(center, axis) Rz(-q) Tx(radius) R(orientation), so its z points against our axis.
  const Eigen::Isometry3d origin = predict(0);
  Eigen::Matrix3d frame;
  frame.col(0) = (origin.translation() - arc_.center()).normalized();
  frame.col(2) = -arc_.axis();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  std::vector<ModelParam> params;
  appendParam("rot_center", arc_.center(), &params);
  appendParam("rot_axis", Eigen::Quaterniond(frame), &params);
  params.push_back({"rot_radius", arc_.radius(), ModelParam::kParam});
  appendParam("rot_orientation", Eigen::Quaterniond(frame.transpose() * origin.linear()), &params);
  params.push_back({"rot_mode", 0, ModelParam::kParam});
  return params;
}

Eigen::Isometry3d RotationalModel::predictLearned(const LearnedModel& model, double q) {
  const Eigen::Translation3d to_axis(model.axis_point);
  return to_axis * Eigen::AngleAxisd(q, model.axis) * to_axis.inverse() * model.origin;
}

double RotationalModel::configurationOfLearned(const LearnedModel& model, const Eigen::Isometry3d& front) {
  const Eigen::Vector3d from = model.origin.translation() - model.axis_point, to = front.translation() - model.axis_point;
  const double by_place = turnAbout(model.axis, from, to);
  const Eigen::Quaterniond turned(front.linear() * model.origin.linear().transpose());
  const double by_turn = 2 * std::atan2(turned.vec().dot(model.axis), turned.w());
  // A front close to its axis hardly changes its place, but turns all the same.
  const double share = kMetresPerRadian * kMetresPerRadian / (kMetresPerRadian * kMetresPerRadian + from.squaredNorm());
  const double middle = (model.q_min + model.q_max) / 2;
  const double q = by_place + share * std::remainder(by_turn - by_place, 2 * M_PI);
  return middle + std::remainder(q - middle, 2 * M_PI);
}

Matrix6d RotationalModel::jacobianOfLearned(const LearnedModel& model, double q) {
  // The front is known best in the middle of what was seen; from there it turns by `turn` about the uncertain axis.
  const double middle = (model.q_min + model.q_max) / 2;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(q - middle, model.axis).toRotationMatrix();
  const Eigen::Vector3d arm = model.predict(middle).translation() - model.axis_point;
  const Eigen::Matrix3d rest = Eigen::Matrix3d::Identity() - turn;
  Matrix6d J = Matrix6d::Identity();
  J.topLeftCorner<3, 3>() = rest;
  J.topRightCorner<3, 3>() = turn * crossMatrix(arm) - crossMatrix(turn * arm);
  J.bottomRightCorner<3, 3>() = rest;
  return J;
}

LearnedModel RotationalModel::example() {
  LearnedModel door = closedExample(JointType::kRotational);
  door.axis = -door.origin.linear().col(1);
  door.axis_point = door.origin * Eigen::Vector3d(-door.width / 2, 0, 0);
  door.radius = door.width / 2;
  door.q_max = 1.2;
  return door;
}

}  // namespace cabinet_articulation::core
