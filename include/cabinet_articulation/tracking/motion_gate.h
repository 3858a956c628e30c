// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/geometry/rectangle.h"
#include "cabinet_articulation/tracking/tracking_config.h"

namespace cabinet_articulation::core {

/// Can one front move between two places (same size and corner choice) in this time? Yes if it comes out along its
/// normal (a drawer) or swings about one of its edges (a door), as far as speeds allow, within the tolerances along its
/// plane; these are at most 0.4 of its sides, so that a front is never confused with its equal neighbour. Ours: fixed
/// thresholds on the pose change (paper, III-C) are either too wide for neighbours or too narrow for a fast pull.
bool isPossibleMotion(const Rectangle& from, const Rectangle& to, double seconds, const TrackingConfig& config);

/// Root mean square distance of corresponding corners [m]: position, orientation and size in one number.
double cornerDistance(const Rectangle& a, const Rectangle& b);

}  // namespace cabinet_articulation::core
