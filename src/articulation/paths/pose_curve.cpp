// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/paths/pose_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cabinet_articulation::core {
namespace {

std::vector<PoseCurve::Knot> knotsOf(const std::vector<Eigen::Isometry3d>& poses) {
  std::vector<PoseCurve::Knot> knots;
  for (const Eigen::Isometry3d& pose : poses) {
    PoseCurve::Knot knot;
    knot << pose.translation(), Eigen::Quaterniond(pose.linear()).coeffs();
    if (!knots.empty() && knots.back().tail<4>().dot(knot.tail<4>()) < 0) knot.tail<4>() *= -1;
    knots.push_back(knot);
  }
  return knots;
}

}  // namespace

PoseCurve::PoseCurve(std::vector<Knot> knots, double q_first, double q_last)
    : knots_(std::move(knots)), first_(q_first), step_((q_last - q_first) / static_cast<double>(knots_.size() - 1)) {}

PoseCurve::PoseCurve(const std::vector<Eigen::Isometry3d>& poses, double q_first, double q_last)
    : PoseCurve(knotsOf(poses), q_first, q_last) {}

PoseCurve::Weights PoseCurve::weights(std::size_t knots, double first, double step, double q) {
  const auto last = static_cast<Eigen::Index>(knots) - 1;
  const double place = (q - first) / step;
  const double inside = std::clamp(place, 0.0, static_cast<double>(last));
  const Eigen::Index segment = std::min(static_cast<Eigen::Index>(inside), last - 1);
  const double u = inside - static_cast<double>(segment), u2 = u * u, u3 = u2 * u;
  Weights w;
  w.value << -u3 + 2 * u2 - u, 3 * u3 - 5 * u2 + 2, -3 * u3 + 4 * u2 + u, u3 - u2;
  w.slope << -3 * u2 + 4 * u - 1, 9 * u2 - 10 * u, -9 * u2 + 8 * u + 1, 3 * u2 - 2 * u;
  w.value += (place - inside) * w.slope;
  w.first = segment - 1;
  // Knots that would lie before and behind the ends continue the second differences.
  for (Eigen::Vector4d* weight : {&w.value, &w.slope}) {
    *weight /= 2;
    if (segment == 0)
      *weight = Eigen::Vector4d(3 * (*weight)[0] + (*weight)[1], (*weight)[2] - 3 * (*weight)[0], (*weight)[3] + (*weight)[0], 0)
                    .eval();
    if (segment == last - 1)
      *weight = Eigen::Vector4d(0, (*weight)[0] + (*weight)[3], (*weight)[1] - 3 * (*weight)[3], (*weight)[2] + 3 * (*weight)[3])
                    .eval();
  }
  if (segment == 0) w.first = 0;
  if (segment == last - 1) w.first = last - 3;
  w.slope /= step;
  return w;
}

PoseCurve::Knot PoseCurve::sum(Eigen::Index first, const Eigen::Vector4d& weights) const {
  const Knot* knot = &knots_[static_cast<std::size_t>(first)];
  return weights[0] * knot[0] + weights[1] * knot[1] + weights[2] * knot[2] + weights[3] * knot[3];
}

Eigen::Isometry3d PoseCurve::pose(double q) const {
  const Weights w = weights(knots_.size(), first_, step_, q);
  const Knot knot = sum(w.first, w.value);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = knot.head<3>();
  pose.linear() = Eigen::Quaterniond(Eigen::Vector4d(knot.tail<4>())).normalized().toRotationMatrix();
  return pose;
}

double PoseCurve::nearestFrom(double q, const Eigen::Isometry3d& pose, double metres_per_radian) const {
  constexpr int kSteps = 30;
  const double scale = 2 * metres_per_radian;  // of a quaternion's change, which is half the angle
  Eigen::Vector4d turn = Eigen::Quaterniond(pose.linear()).coeffs();
  for (int i = 0; i < kSteps; ++i) {
    const Weights w = weights(knots_.size(), first_, step_, q);
    const Knot at = sum(w.first, w.value), slope = sum(w.first, w.slope);
    const double length = at.tail<4>().norm();
    const Eigen::Vector4d unit = at.tail<4>() / length;
    const Eigen::Vector4d unit_slope = (slope.tail<4>() - unit * unit.dot(slope.tail<4>())) / length;
    if (turn.dot(unit) < 0) turn = -turn;
    const double along = slope.head<3>().dot(pose.translation() - at.head<3>()) + scale * scale * unit_slope.dot(turn - unit);
    const double square = slope.head<3>().squaredNorm() + scale * scale * unit_slope.squaredNorm();
    if (!(square >= 1e-18)) break;  // also where quaternions cancel out, which has no direction
    const double change = std::clamp(along / square, -4 * step_, 4 * step_);
    q += change;
    if (std::abs(change) < 1e-9) break;
  }
  return q;
}

double PoseCurve::nearest(const Eigen::Isometry3d& pose, double metres_per_radian) const {
  const double scale = 2 * metres_per_radian;
  const Eigen::Vector4d turn = Eigen::Quaterniond(pose.linear()).coeffs();
  double least = std::numeric_limits<double>::infinity(), best = first_;
  for (std::size_t i = 0; i < knots_.size(); ++i) {
    const double cosine = std::abs(knots_[i].tail<4>().dot(turn)) / knots_[i].tail<4>().norm();
    const double square = (knots_[i].head<3>() - pose.translation()).squaredNorm() + 2 * scale * scale * (1 - cosine);
    if (square < least) {
      least = square;
      best = first_ + step_ * static_cast<double>(i);
    }
  }
  return nearestFrom(best, pose, metres_per_radian);
}

PoseCurve PoseCurve::reparametrised(double origin, bool reversed) const {
  PoseCurve curve = *this;
  curve.first_ = reversed ? origin - last() : first_ - origin;
  if (reversed) std::reverse(curve.knots_.begin(), curve.knots_.end());
  return curve;
}

}  // namespace cabinet_articulation::core
