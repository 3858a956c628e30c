// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cabinet_articulation::core {

// What noise is taken for before any residual is seen (measured).
constexpr double kTypicalPositionNoise = 0.002;     ///< [m]
constexpr double kTypicalOrientationNoise = 0.019;  ///< [rad]

/// [m], [rad] Noise is never taken for less than what the rounding of logs leaves.
constexpr double kLogRounding = 5e-5;

}  // namespace cabinet_articulation::core
