// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "cabinet_articulation/geometry/plane.h"

namespace cabinet_articulation::core {

/// The edges in the order in which messages and covariances list them.
enum Edge { kEdgeMinusX = 0, kEdgePlusX = 1, kEdgeMinusY = 2, kEdgePlusY = 3 };

/// A rectangle in space. `pose` places its CENTRE in the frame the context names: x is along the width, y along the height. z is
/// the normal on the side that was seen.
struct Rectangle {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  double width = 0;   ///< [m]
  double height = 0;  ///< [m]

  Eigen::Vector3d center() const { return pose.translation(); }
  Eigen::Vector3d normal() const { return pose.linear().col(2); }
  Plane plane() const { return {normal(), -normal().dot(center())}; }

  /// (-x,-y), (+x,-y), (+x,+y), (-x,+y)
  std::array<Eigen::Vector3d, 4> corners() const;
};

/// The eight parameter vectors that describe one rectangle (paper, III-C). Index k = 0..3 turns the axes by k * 90 degrees about
/// the normal; width and height swap for odd k. Index k = 4..7 does the same as seen from the back.
constexpr int kDescriptions = 8;
Rectangle describe(const Rectangle& rectangle, int k);

/// Angle of the rotation between two poses [rad], 0..pi.
double angleBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b);

/// The description of `rectangle` whose axes are nearest to those of `reference` by rotation angle. `allow_back` also
/// considers the four descriptions from the other side.
Rectangle alignDescription(const Rectangle& rectangle, const Rectangle& reference, bool allow_back);

/// Intersection over union of `other`, projected along the normal of `reference` into its plane. 0..1.
double intersectionOverUnion(const Rectangle& reference, const Rectangle& other);

}  // namespace cabinet_articulation::core
