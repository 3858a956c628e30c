// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace cabinet_articulation::core {

/// Where on an arc a point belongs, with what derivatives need. All in the arc's frame.
struct ArcPlace {
  double theta = 0;  ///< [rad] how far the arc has turned there
  double cosine = 1, sine = 0;
  double length = 0;   ///< [m] s
  double outward = 0;  ///< [m] signed distance from the arc
  double along = 0;    ///< [m] left over along the tangent
  double bend = 0;     ///< [m^2] (1 - cos theta) / curvature^2: how the arc moves inward there when it bends more
  double stretch = 0;  ///< [m^2] (theta - sin theta) / curvature^2: the same along the tangent, at fixed s
};

/// Closer to an arc's axis than so many ratios of position noise to orientation noise [m/rad], orientations say better how far it
/// has turned (ours).
constexpr double kReachOfOrientations = 2.5;

/// The nearest place; `length`, `theta` and `stretch` are left out.
ArcPlace nearestPlace(const Eigen::Vector3d& p, double curvature);

/// The nearest place.
ArcPlace nearestPlaceWithLength(const Eigen::Vector3d& p, double curvature);

/// The place at which an arc has turned by `theta`.
ArcPlace placeAtAngle(const Eigen::Vector3d& p, double curvature, double theta);

}  // namespace cabinet_articulation::core
