// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cabinet_articulation::core {

/// Angles are radians everywhere; these two serve what people read and write.
constexpr double kDegree = 3.14159265358979323846 / 180;  ///< [rad]
constexpr double toDegrees(double radians) { return radians / kDegree; }

}  // namespace cabinet_articulation::core
