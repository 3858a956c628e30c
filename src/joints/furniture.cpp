// SPDX-License-Identifier: BSD-3-Clause
#include "joints/furniture.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/connected_components.hpp>
#include <cmath>
#include <limits>

#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/geometry/rectangle.h"
#include "cabinet_articulation/joints/prediction.h"

namespace cabinet_articulation::core {
namespace {

// EN 1116: worktops are at least 0.6 m deep. Units and appliances are commonly up to 0.6 m wide.
constexpr double kUnit = 0.6;                   // [m]
constexpr double kFlush = 0.002;                // [m] what the screws of hinges and runners adjust (ours)
constexpr double kEven = kFlush / (kUnit / 2);  // [rad] that at the edge of a front
constexpr double kHalfSphere = 2 * M_PI;        // [sr]

using Offset = Eigen::Vector3d;  // distance [m], tilt about two directions within the plane [rad]

struct Closed {
  explicit Closed(const LearnedModel& model) {
    const UncertainPose closed = predictWithCovariance(model, closedConfiguration(model));
    front = {closed.pose, model.width, model.height};
    covariance = closed.covariance;
  }
  Eigen::Vector3d normal() const { return front.pose.linear().col(2); }

  Rectangle front;
  Matrix6d covariance;
};

/// Logarithm of N(e; 0, S); of less than everything for an S that is none.
template <int size>
double logLikelihood(const Eigen::Matrix<double, size, 1>& e, const Eigen::Matrix<double, size, size>& S) {
  const Eigen::LLT<Eigen::Matrix<double, size, size>> root(S);
  if (root.info() != Eigen::Success) return -std::numeric_limits<double>::infinity();
  const Eigen::Matrix<double, size, size> L = root.matrixL();
  return -0.5 * L.template triangularView<Eigen::Lower>().solve(e).squaredNorm() - L.diagonal().array().log().sum() -
         0.5 * size * std::log(2 * M_PI);
}

bool areInOnePlane(const Closed& a, const Closed& b) {
  if (a.normal().dot(b.normal()) <= 0) return false;  // they face opposite sides
  const Eigen::Vector3d n = (a.normal() + b.normal()).normalized();
  const Eigen::Vector3d u = n.unitOrthogonal(), v = n.cross(u);
  const Eigen::Vector3d middle = (a.front.center() + b.front.center()) / 2;
  const auto height = [&](const Closed& closed) {
    return closed.normal().dot(closed.front.center() - middle) / closed.normal().dot(n);
  };
  const auto jacobian = [&](const Closed& closed) {
    Eigen::Matrix<double, 3, 6> J = Eigen::Matrix<double, 3, 6>::Zero();
    J.block<1, 3>(0, 0) = n.transpose();
    J.block<1, 3>(0, 3) = (middle - closed.front.center()).cross(n).transpose();
    J.block<1, 3>(1, 3) = u.transpose();
    J.block<1, 3>(2, 3) = v.transpose();
    return J;
  };
  const Eigen::Vector3d tilt = a.normal().cross(b.normal());
  const Offset e(height(b) - height(a), tilt.dot(u), tilt.dot(v));
  const Eigen::Matrix<double, 3, 6> J_a = jacobian(a), J_b = jacobian(b);
  Eigen::Matrix3d S = Offset(kFlush * kFlush, kEven * kEven, kEven * kEven).asDiagonal();
  S += J_a * a.covariance * J_a.transpose() + J_b * b.covariance * J_b.transpose();
  const Eigen::Matrix<double, 1, 1> distance(e[0]), variance(S(0, 0));
  return logLikelihood<1>(distance, variance) > -std::log(kUnit) && logLikelihood<3>(e, S) > -std::log(kUnit * kHalfSphere);
}

/// [m] between the outlines, along the sides of `a`; 0 where they overlap.
double gapBetween(const Rectangle& a, const Rectangle& b) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Eigen::Array2d low(kInfinity, kInfinity), high = -low;
  for (const Eigen::Vector3d& corner : b.corners()) {
    const Eigen::Array2d in_a = (a.pose.inverse() * corner).head<2>().array();
    low = low.min(in_a);
    high = high.max(in_a);
  }
  const Eigen::Array2d half(a.width / 2, a.height / 2);
  return (low - half).max(-high - half).max(0).matrix().norm();
}

}  // namespace

double closedConfiguration(const LearnedModel& model) {
  return model.closed_known && isWithin(model.q_closed, limits::kConfiguration) ? model.q_closed : 0;
}

std::vector<std::vector<std::size_t>> piecesOfFurniture(const std::vector<LearnedModel>& joints) {
  const std::vector<Closed> closed(joints.begin(), joints.end());
  boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS> pairs(joints.size());
  for (std::size_t i = 0; i < joints.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (gapBetween(closed[i].front, closed[j].front) <= kUnit && areInOnePlane(closed[i], closed[j]))
        boost::add_edge(i, j, pairs);
  std::vector<std::size_t> piece_of(joints.size());
  const std::size_t count = joints.empty() ? 0 : boost::connected_components(pairs, piece_of.data());
  std::vector<std::vector<std::size_t>> pieces(count);
  for (std::size_t i = 0; i < joints.size(); ++i) pieces[piece_of[i]].push_back(i);
  return pieces;
}

}  // namespace cabinet_articulation::core
