// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "cabinet_articulation/geometry/joint_type.h"

namespace cabinet_articulation::core {

/// A prismatic or rotational joint as its front sees it, wherever the front is.
struct JointShape {
  JointType type = JointType::kPrismatic;
  /// In the front's own frame; columns: direction of opening, from the front's centre to the hinge, axis. Only the first counts
  /// where nothing turns.
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  double radius = 0;             ///< [m] from the front's centre to the axis; 0: nothing turns
  double width = 0, height = 0;  ///< [m] of the front; 0: unknown
  double range = 0;              ///< [m; where it turns rad] that was seen of its way; 0: unknown
  std::uint32_t front = 0;       ///< id of the front that it is of; 0: that is not known any more

  bool turns() const { return type == JointType::kRotational; }
  bool hasSize() const { return width > 0 && height > 0; }
  /// Number of parameters: two of a direction, or three of a frame and the radius.
  int dimensions() const { return turns() ? 4 : 2; }
};

/// So many joints are known of all kinds, in memory and in a file (ours: the fronts of a large building, some 100 kB).
constexpr std::size_t kMostShapes = 256;

/// Whether both are one joint, whatever the ids: equal but for the digits that a file has not.
inline bool isSame(const JointShape& a, const JointShape& b) {
  constexpr double kDigits = 1e-9;
  return a.type == b.type && a.frame.isApprox(b.frame, kDigits) && std::abs(a.radius - b.radius) < kDigits &&
         std::abs(a.width - b.width) < kDigits && std::abs(a.height - b.height) < kDigits &&
         std::abs(a.range - b.range) < kDigits;
}

}  // namespace cabinet_articulation::core
