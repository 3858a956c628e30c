// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/paths/arc.h"

#include <algorithm>
#include <cmath>

namespace cabinet_articulation::core {
namespace {

/// Below this curvature [1/m] an arc of a metre deviates from a line by less than rounding does.
constexpr double kStraight = 1e-9;

}  // namespace

Eigen::Matrix3d rotationFromVector(const Eigen::Vector3d& v) {
  const double angle = v.norm();
  if (angle < 1e-12) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, v / angle).toRotationMatrix();
}

Eigen::Vector3d rotationVector(Eigen::Quaterniond q) {
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  return sine < 1e-12 ? Eigen::Vector3d(2 * q.vec()) : Eigen::Vector3d(2 * std::atan2(sine, q.w()) / sine * q.vec());
}

Eigen::Matrix3d arcFrame(const Eigen::Vector3d& tangent, const Eigen::Vector3d& towards) {
  Eigen::Matrix3d frame;
  frame.col(0) = tangent.normalized();
  Eigen::Vector3d inward = towards - frame.col(0) * frame.col(0).dot(towards);
  if (inward.norm() < 1e-9 * (1 + towards.norm())) inward = frame.col(0).unitOrthogonal();
  frame.col(1) = inward.normalized();
  frame.col(2) = frame.col(0).cross(frame.col(1));
  return frame;
}

double Arc::arcLength(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d local = frame.transpose() * (p - middle);
  if (std::abs(curvature) < kStraight) return local.x();
  // With a negative curvature both arguments are those of the mirrored arc.
  return std::atan2(curvature * local.x(), 1 - curvature * local.y()) / curvature;
}

double Arc::squaredDistance(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d local = frame.transpose() * (p - middle);
  const double g = curvature * local.head<2>().squaredNorm() - 2 * local.y();
  const double outward = g / (1 + std::sqrt(std::max(0.0, 1 + curvature * g)));
  return outward * outward + local.z() * local.z();
}

Eigen::Vector3d Arc::point(double s) const {
  if (std::abs(curvature) < kStraight) return middle + frame.col(0) * s;
  const double half = curvature * s / 2;
  const double chord = 2 * std::sin(half) / curvature;
  return middle + frame.col(0) * (chord * std::cos(half)) + frame.col(1) * (chord * std::sin(half));
}

Eigen::Isometry3d Arc::pose(double s) const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = point(s);
  pose.linear() = Eigen::AngleAxisd(curvature * s, axis()) * orientation;
  return pose;
}

Arc Arc::recentered(double s) const {
  Arc arc = *this;
  arc.middle = point(s);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(curvature * s, axis()).toRotationMatrix();
  // A path that is recentered with every new pose must not gather rounding. Turning about an axis that is not quite a unit vector
  // makes it grow.
  arc.frame = arcFrame(turn * frame.col(0), turn * frame.col(1));
  arc.orientation = Eigen::Quaterniond(turn * orientation).normalized();
  return arc;
}

Arc Arc::shifted(const Eigen::Vector3d& offset) const {
  Arc arc = *this;
  arc.middle = middle + orientation * offset;
  if (std::abs(curvature) < kStraight) return arc;
  Eigen::Vector3d inward = center() - arc.middle;
  inward -= axis() * axis().dot(inward);
  const double new_radius = inward.norm();
  if (new_radius < 1e-6) return arc;
  const double turn = curvature > 0 ? 1 : -1;
  arc.frame.col(1) = turn * inward / new_radius;
  arc.frame.col(0) = arc.frame.col(1).cross(axis());
  arc.curvature = turn / new_radius;
  return arc;
}

double meanArcLength(const Arc& arc, const std::vector<Eigen::Vector3d>& points) {
  // The mean of the points themselves lies in the mean direction: only the centre of a full turn has none.
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) mean += p / static_cast<double>(points.size());
  return arc.arcLength(mean);
}

}  // namespace cabinet_articulation::core
