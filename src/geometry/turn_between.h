// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace cabinet_articulation::core {

/// [rad] Angle of the rotation between two poses, 0..pi. It differs from angleBetween() of rectangle.h in the last bits of turns
/// below 1e-15. Those are scaled here before they are squared, so that nothing is lost.
inline double turnBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

}  // namespace cabinet_articulation::core
