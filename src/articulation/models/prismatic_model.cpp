// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/models/prismatic_model.h"

#include "geometry/cross_matrix.h"

namespace cabinet_articulation::core {

JointGeometry PrismaticModel::geometry() const { return {arc_.tangent(), Eigen::Vector3d::Zero(), 0, 0}; }

Matrix6d PrismaticModel::covariance(const PoseSequence& track, const Eigen::Vector3d& p, double correlation) const {
  // The origin's position follows the line's middle across it, and the front's orientation by its lever.
  const double away = arc_.tangent().dot(p - arc_.middle);
  Eigen::Matrix<double, 6, 9> jacobian = Eigen::Matrix<double, 6, 9>::Zero();
  jacobian.block<3, 2>(0, 0) = arc_.frame.rightCols<2>();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d turn = arc_.frame.col(i);
    jacobian.block<3, 1>(0, 2 + i) = turn.cross(away * arc_.tangent());
    if (i > 0) jacobian.block<3, 1>(3, 2 + i) = turn;
    jacobian.block<3, 1>(0, 6 + i) = turn.cross(p - arc_.point(away));
  }
  return jacobian * parameterCovariance(track, correlation) * jacobian.transpose();
}

std::vector<ModelParam> PrismaticModel::parameters() const {
  std::vector<ModelParam> params;
  const Eigen::Isometry3d origin = predict(0);
  appendParam("rigid_position", Eigen::Vector3d(origin.translation()), &params);
  appendParam("rigid_orientation", Eigen::Quaterniond(origin.linear()), &params);
  appendParam("prismatic_dir", arc_.tangent(), &params);
  return params;
}

Eigen::Isometry3d PrismaticModel::predictLearned(const LearnedModel& model, double q) {
  return Eigen::Translation3d(q * model.axis) * model.origin;
}

double PrismaticModel::configurationOfLearned(const LearnedModel& model, const Eigen::Isometry3d& front) {
  return model.axis.dot(front.translation() - model.origin.translation());
}

Matrix6d PrismaticModel::jacobianOfLearned(const LearnedModel& model, double q) {
  Matrix6d J = Matrix6d::Identity();
  J.topRightCorner<3, 3>() = -q * crossMatrix(model.axis);
  J.bottomRightCorner<3, 3>().setZero();
  return J;
}

LearnedModel PrismaticModel::example() {
  LearnedModel drawer = closedExample(JointType::kPrismatic);
  drawer.axis = drawer.origin.linear().col(2);
  drawer.q_max = 0.35;
  return drawer;
}

}  // namespace cabinet_articulation::core
