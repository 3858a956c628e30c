// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "cabinet_articulation/geometry/rectangle.h"
#include "cabinet_articulation/tracking/tracking_config.h"

namespace cabinet_articulation::core {

/// How far [m] a front has to be moved from one place to another (same corner choice) beyond the ways in which fronts do
/// move: out along its normal (a drawer) or about one of its edges (a door). Those cost a quarter of their length. Nothing
/// if no front can do that in this time: faster than the speeds allow, or beyond the tolerances along its plane; these are
/// at most 0.4 of its sides, so that a front is never confused with its equal neighbour, however long it was not seen.
/// Beyond the prediction horizon it may only have opened, towards its normal: the faces of a box look like each other
/// swung inward. Ours: fixed thresholds on the pose change (paper, III-C) are too wide for neighbours or too narrow for a
/// fast pull.
std::optional<double> motionDistance(const Rectangle& from, const Rectangle& to, double seconds, const TrackingConfig& config);

/// No detection of the front lies farther from its last place than this [m], whatever part of it was seen. Cheap.
double reach(const Rectangle& from, double seconds, const TrackingConfig& config);

/// Root mean square distance of corresponding corners [m]: position, orientation and size in one number.
double cornerDistance(const Rectangle& a, const Rectangle& b);

}  // namespace cabinet_articulation::core
