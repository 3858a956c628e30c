// SPDX-License-Identifier: BSD-3-Clause
#include "kinds/shape_geometry.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace cabinet_articulation::core {

bool hasShape(const LearnedModel& joint) {
  if (joint.type != JointType::kRotational) return joint.type == JointType::kPrismatic;
  constexpr double kRounding = 1e-3;  // share of the radius (ours): files round, and a map may count from far away
  const double arm = (joint.axis_point - joint.origin.translation()).cross(joint.axis).norm();
  return joint.radius > 0 && std::abs(arm - joint.radius) <= kRounding * joint.radius;
}

JointShape shapeOf(const LearnedModel& joint, const Eigen::Matrix3d& start) {
  JointShape shape;
  shape.type = joint.type;
  const bool turns = shape.turns();
  const Eigen::Vector3d to_axis = joint.axis_point - joint.origin.translation();
  const Eigen::Vector3d opening = turns ? Eigen::Vector3d(to_axis.cross(joint.axis)) : joint.axis;
  shape.frame = start.transpose() * arcFrame(opening, turns ? to_axis : Eigen::Vector3d::Zero());
  shape.radius = turns ? joint.radius : 0;
  shape.width = joint.width;
  shape.height = joint.height;
  shape.range = joint.q_max - joint.q_min;
  shape.front = joint.id;
  constexpr double kInwards = -0.5;  // cosine of 120 degrees from the normal: what slides sideways stays as it was seen
  if (shape.hasSize() && shape.frame(2, 0) < kInwards) shape.frame = shape.frame * Eigen::Vector3d(-1, 1, -1).asDiagonal();
  return shape;
}

JointShape shapeOf(const Arc& arc, JointType type, const Eigen::Matrix3d& start) {
  JointShape shape;
  shape.type = type;
  shape.frame = start.transpose() * arc.frame;
  shape.radius = shape.turns() ? arc.radius() : 0;
  return shape;
}

Eigen::VectorXd difference(const JointShape& shape, const JointShape& mean) {
  Eigen::VectorXd by(mean.dimensions());
  if (mean.turns()) {
    by << rotationVector(Eigen::Quaterniond(mean.frame.transpose() * shape.frame)), std::log(shape.radius / mean.radius);
    return by;
  }
  // The shortest turn that takes one direction to the other.
  const Eigen::Vector3d direction = mean.frame.transpose() * shape.frame.col(0);
  const Eigen::Vector3d turn = rotationVector(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), direction));
  by << turn.y(), turn.z();
  return by;
}

JointShape movedBy(const JointShape& mean, const Eigen::VectorXd& by) {
  JointShape shape = mean;
  const Eigen::Vector3d turn = mean.turns() ? Eigen::Vector3d(by.head<3>()) : Eigen::Vector3d(0, by[0], by[1]);
  shape.frame = mean.frame * rotationFromVector(turn);
  if (mean.turns()) shape.radius *= std::exp(by[3]);
  return shape;
}

JointShape meanShape(const std::vector<JointShape>& shapes) {
  constexpr int kRounds = 10;  // each leaves a hundredth or less of the error
  JointShape mean = shapes.front();
  for (int round = 0; round < kRounds; ++round) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(mean.dimensions());
    for (const JointShape& shape : shapes) sum += difference(shape, mean);
    mean = movedBy(mean, sum / static_cast<double>(shapes.size()));
  }
  return mean;
}

Eigen::MatrixXd shapeCovariance(const LearnedModel& joint, const JointShape& mean) {
  // A turn of the axis about itself changes nothing, but a step of the axis' point along the path turns the frame about it.
  Eigen::Matrix<double, 3, 6> turn = Eigen::Matrix<double, 3, 6>::Zero();
  turn.rightCols<3>() = Eigen::Matrix3d::Identity() - joint.axis * joint.axis.transpose();
  const Eigen::Matrix3d frame = joint.origin.linear() * mean.frame;
  Eigen::MatrixXd J(mean.dimensions(), 6);
  if (!mean.turns()) {
    J = frame.rightCols<2>().transpose() * turn;
  } else {
    const Eigen::Vector3d to_axis = (joint.axis_point - joint.origin.translation()) / joint.radius;
    turn.leftCols<3>() = joint.axis * joint.axis.cross(to_axis).transpose() / joint.radius;
    J.topRows<3>() = frame.transpose() * turn;
    J.bottomRows<1>() << to_axis.transpose() / joint.radius, Eigen::RowVector3d::Zero();
  }
  return J * joint.covariance * J.transpose();
}

ShapeSigmas shapeSigmas(const LearnedModel& joint) {
  const JointShape own = shapeOf(joint, joint.origin.linear());
  const Eigen::MatrixXd covariance = shapeCovariance(joint, own);
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  if (!covariance.allFinite()) return {kUnknown, kUnknown};  // of a file, and too large to count with
  const Eigen::Index turns = own.turns() ? 3 : 2;
  const Eigen::MatrixXd of_turn = covariance.topLeftCorner(turns, turns);
  const double turn = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(of_turn).eigenvalues().maxCoeff();
  return {std::sqrt(std::max(0.0, turn)), own.turns() ? std::sqrt(std::max(0.0, covariance(3, 3))) : 0};
}

}  // namespace cabinet_articulation::core
