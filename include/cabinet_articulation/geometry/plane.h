// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "cabinet_articulation/geometry/stereo_camera.h"

namespace cabinet_articulation::core {

/// normal . p + offset = 0 with a unit normal towards the camera, so offset > 0 is the camera's distance (Eq. 1).
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset = 0;  ///< [m]

  /// Signed distance [m], positive on the camera's side.
  double distance(const Eigen::Vector3d& p) const { return normal.dot(p) + offset; }

  /// Where the ray through the camera's centre meets the plane; nothing if it is parallel to it or meets it behind.
  std::optional<Eigen::Vector3d> intersect(const Eigen::Vector3d& ray) const;
};

/// A plane in the disparity image: disparity = a u + b v + c. Exact for a rectified pinhole pair (ours: what makes a mask
/// one pass over the disparity image).
struct DisparityPlane {
  double a = 0;  ///< [px/px]
  double b = 0;  ///< [px/px]
  double c = 0;  ///< [px]

  double at(double u, double v) const { return a * u + b * v + c; }
};

/// A plane through the camera's centre has no image; both directions return nothing for it.
std::optional<DisparityPlane> toDisparityPlane(const Plane& plane, const StereoCamera& camera);
std::optional<Plane> toPlane(const DisparityPlane& plane, const StereoCamera& camera);

}  // namespace cabinet_articulation::core
