// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace cabinet_articulation::core {

/// The path of a front on a joint with one degree of freedom, with the front turning along. It is an arc of a circle, or a line
/// where `curvature` is 0. It is described from its middle by its curvature (ours): the usual centre and radius run to infinity
/// where an arc is nearly straight. So a line is an ordinary arc, and prismatic and rotational joints are one family.
struct Arc {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();           ///< [m] the point at s = 0
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();        ///< columns: tangent, direction to the centre, axis
  double curvature = 0;                                       ///< [1/m] 1 / radius; negative bends the other way
  Eigen::Matrix3d orientation = Eigen::Matrix3d::Identity();  ///< of the front at s = 0

  Eigen::Vector3d tangent() const { return frame.col(0); }
  Eigen::Vector3d axis() const { return frame.col(2); }
  double radius() const { return 1 / curvature; }
  Eigen::Vector3d center() const { return middle + frame.col(1) / curvature; }

  /// Arc length [m] of the point nearest to p. The cut of a full circle lies opposite to the middle.
  double arcLength(const Eigen::Vector3d& p) const;
  /// Squared distance [m^2] of p from the whole line or circle.
  double squaredDistance(const Eigen::Vector3d& p) const;
  Eigen::Vector3d point(double s) const;
  Eigen::Isometry3d pose(double s) const;

  /// The same path with its middle moved to s.
  Arc recentered(double s) const;

  /// The path of another point of the same front: `offset` away in the front's frame.
  Arc shifted(const Eigen::Vector3d& offset) const;
};

/// [m] Arc length of the mean of the points: on a circle in the mean direction as seen from its centre. So the cut of an arc that
/// is recentered there lies opposite to them.
double meanArcLength(const Arc& arc, const std::vector<Eigen::Vector3d>& points);

/// Rotation by the rotation vector v.
Eigen::Matrix3d rotationFromVector(const Eigen::Vector3d& v);

/// The rotation vector, at most pi long, of a unit quaternion; the inverse of rotationFromVector().
Eigen::Vector3d rotationVector(Eigen::Quaterniond q);

/// An orthonormal right-handed frame whose first column is `tangent` and whose second leans towards `towards`.
Eigen::Matrix3d arcFrame(const Eigen::Vector3d& tangent, const Eigen::Vector3d& towards);

}  // namespace cabinet_articulation::core
