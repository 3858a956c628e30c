// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace cabinet_articulation::core {

/// [rad] Angle of the rotation between two poses, 0..pi. It differs from angleBetween() of rectangle.h in the last bits of turns
/// below 1e-15. Those are scaled here before they are squared, so that nothing is lost.
inline double turnBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

/// [rad] The turn about a unit axis that takes `from` towards `to`, -pi..pi, by their parts across the axis.
inline double turnAbout(const Eigen::Vector3d& axis, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return std::atan2(axis.dot(from.cross(to)), from.dot(to) - axis.dot(from) * axis.dot(to));
}

}  // namespace cabinet_articulation::core
