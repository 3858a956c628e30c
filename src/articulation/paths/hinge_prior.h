// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "articulation/paths/arc.h"

namespace cabinet_articulation::core {

/// What is known about a hinge before its front was seen to turn (ours): it is at an edge of the front, in its plane. Poses of a
/// front that turns but little do not tell where its axis is.
struct HingePrior {
  double sigma = 0;                                     ///< [m] standard deviation of either distance; 0: nothing is known
  Eigen::Vector3d center = Eigen::Vector3d::Zero();     ///< [m] of the front, in its own frame as seen from the reference point
  Eigen::Vector2d half_size = Eigen::Vector2d::Zero();  ///< [m] half of the front's width and height

  /// How far the axis of a circle is off the front's plane, and within the plane off its nearest edge, in standard deviations.
  /// The latter is in the direction across the axis, and less, the more upright the axis stands on the front.
  Eigen::Vector2d residuals(const Arc& arc) const;

  /// Their derivatives by ArcProblem's parameters.
  Eigen::Matrix<double, 2, 9> jacobian(const Arc& arc) const;
};

}  // namespace cabinet_articulation::core
