// SPDX-License-Identifier: BSD-3-Clause
#include "joints/furniture.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/connected_components.hpp>
#include <cmath>
#include <limits>
#include <optional>

#include "articulation/models/model_registry.h"
#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/geometry/rectangle.h"
#include "cabinet_articulation/joints/prediction.h"
#include "geometry/turn_between.h"
#include "joints/front_place.h"

namespace cabinet_articulation::core {
namespace {

// EN 1116: worktops are at least 0.6 m deep. Units and appliances are commonly up to 0.6 m wide.
constexpr double kUnit = 0.6;                   // [m]
constexpr double kFlush = 0.002;                // [m] what the screws of hinges and runners adjust (ours)
constexpr double kEven = kFlush / (kUnit / 2);  // [rad] that at the edge of a front
constexpr double kHalfSphere = 2 * M_PI;        // [sr]
constexpr double kToldApart = 0.05;  // [m] closed fronts are told from their neighbours once they stand out (measured: 0.03)

using Offset = Eigen::Vector3d;  // distance [m], tilt about two directions within the plane [rad]

/// A front at one opening, where it may be closed.
struct Closed {
  Closed(const LearnedModel& model, double q) {
    const UncertainPose closed = predictWithCovariance(model, q);
    front = {closed.pose, model.width, model.height};
    covariance = closed.covariance;
  }
  Eigen::Vector3d normal() const { return front.pose.linear().col(2); }

  Rectangle front;
  Matrix6d covariance;
  double within = 0;  ///< [m] of this length of its way across the plane, any place is as likely
};

bool isClosedKnown(const LearnedModel& model) { return model.closed_known && isWithin(model.q_closed, limits::kConfiguration); }

std::vector<Closed> whereItMayBeClosed(const LearnedModel& model) {
  if (isClosedKnown(model)) return {Closed(model, model.q_closed)};
  if (model.q_min == 0) return {Closed(model, 0)};
  return {Closed(model, 0), Closed(model, model.q_min)};
}

/// Somewhat beyond what was seen of its way, where it is parallel to the other (if it turns) or comes into its plane.
std::optional<Closed> towardsPlaneOf(const Closed& other, const LearnedModel& model) {
  if (isClosedKnown(model)) return std::nullopt;
  const Eigen::Vector3d axis = model.axis.normalized(), n = other.normal();
  if (modelEntry(model.type).turns) {
    const Eigen::Vector3d from = model.origin.linear().col(2);
    const double q = turnAbout(axis, from, n);
    const double beyond = std::max(model.q_min - q, q - model.q_max);
    if (!(beyond > 0 && beyond < beyondSeen(model))) return std::nullopt;
    return Closed(model, q);
  }
  const double q = n.dot(other.front.center() - model.origin.translation()) / n.dot(axis);
  const double beyond = model.q_min - q;
  if (!(beyond > 0 && beyond < kToldApart && isWithin(q, limits::kConfiguration))) return std::nullopt;
  Closed closed(model, q);
  closed.within = kToldApart * std::abs(n.dot(axis));
  return closed;
}

/// Logarithm of N(e; 0, S); of less than everything for an S that is none.
template <int size>
double logLikelihood(const Eigen::Matrix<double, size, 1>& e, const Eigen::Matrix<double, size, size>& S) {
  const Eigen::LLT<Eigen::Matrix<double, size, size>> root(S);
  if (root.info() != Eigen::Success) return -std::numeric_limits<double>::infinity();
  const Eigen::Matrix<double, size, size> L = root.matrixL();
  return -0.5 * L.template triangularView<Eigen::Lower>().solve(e).squaredNorm() - L.diagonal().array().log().sum() -
         0.5 * size * std::log(2 * M_PI);
}

/// [nats] by how much one plane is more likely than anything else.
double evidenceOfOnePlane(const Closed& a, const Closed& b) {
  if (a.normal().dot(b.normal()) <= 0) return -std::numeric_limits<double>::infinity();  // they face opposite sides
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
  const double within = std::max(a.within, b.within);
  if (within > 0)
    return std::min(0.0, logLikelihood<2>(e.tail<2>(), S.bottomRightCorner<2, 2>()) + std::log(kHalfSphere)) +
           std::log(kUnit / within);
  const Eigen::Matrix<double, 1, 1> distance(e[0]), variance(S(0, 0));
  return std::min(logLikelihood<1>(distance, variance) + std::log(kUnit), logLikelihood<3>(e, S) + std::log(kUnit * kHalfSphere));
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

/// Two fronts of one piece, where each is closed.
struct Pair {
  double evidence = 0;  ///< [nats] more than 0
  Eigen::Isometry3d closed_a = Eigen::Isometry3d::Identity(), closed_b = Eigen::Isometry3d::Identity();
};

std::optional<Pair> pairUp(const LearnedModel& a, const std::vector<Closed>& closed_a, const LearnedModel& b,
                           const std::vector<Closed>& closed_b) {
  std::optional<Pair> best;
  const auto consider = [&](const Closed& front_a, const Closed& front_b) {
    if (gapBetween(front_a.front, front_b.front) > kUnit) return;
    const double evidence = evidenceOfOnePlane(front_a, front_b);
    if (evidence > (best ? best->evidence : 0)) best = {evidence, front_a.front.pose, front_b.front.pose};
  };
  for (const Closed& front_a : closed_a) {
    for (const Closed& front_b : closed_b) consider(front_a, front_b);
    const std::optional<Closed> front_b = towardsPlaneOf(front_a, b);
    if (front_b) consider(front_a, *front_b);
    if (!front_b || front_b->within > 0) continue;
    // Once the one is parallel, the other may slide into its plane.
    const std::optional<Closed> behind = towardsPlaneOf(*front_b, a);
    if (behind) consider(*behind, *front_b);
  }
  return best;
}

/// Either may be the one that is moved first.
std::optional<Pair> pairUpEitherWay(const LearnedModel& a, const std::vector<Closed>& closed_a, const LearnedModel& b,
                                    const std::vector<Closed>& closed_b) {
  const std::optional<Pair> forth = pairUp(a, closed_a, b, closed_b), back = pairUp(b, closed_b, a, closed_a);
  if (!back || (forth && forth->evidence >= back->evidence)) return forth;
  return Pair{back->evidence, back->closed_b, back->closed_a};
}

}  // namespace

std::vector<PieceOfFurniture> piecesOfFurniture(const std::vector<LearnedModel>& joints) {
  std::vector<std::vector<Closed>> candidates;
  for (const LearnedModel& joint : joints) candidates.push_back(whereItMayBeClosed(joint));
  std::vector<Pair> best(joints.size());  // closed_a is that of the front itself
  for (std::size_t i = 0; i < joints.size(); ++i) best[i].closed_a = candidates[i].front().front.pose;
  boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS> pairs(joints.size());
  for (std::size_t i = 0; i < joints.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const std::optional<Pair> pair = pairUpEitherWay(joints[i], candidates[i], joints[j], candidates[j]);
      if (!pair) continue;
      boost::add_edge(i, j, pairs);
      if (pair->evidence > best[i].evidence) best[i] = *pair;
      if (pair->evidence > best[j].evidence) best[j] = {pair->evidence, pair->closed_b, pair->closed_a};
    }
  std::vector<std::size_t> piece_of(joints.size());
  const std::size_t count = joints.empty() ? 0 : boost::connected_components(pairs, piece_of.data());
  std::vector<PieceOfFurniture> pieces(count);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    pieces[piece_of[i]].fronts.push_back(i);
    pieces[piece_of[i]].closed.push_back(best[i].closed_a);
  }
  return pieces;
}

}  // namespace cabinet_articulation::core
