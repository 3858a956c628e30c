// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/// The observation whose centre is nearest to `p_fixed`. The history must not be empty.
const TrackedObservation& nearestObservation(const std::vector<TrackedObservation>& history, const Eigen::Vector3d& p_fixed);

/// Keeps a history of more than `limit` observations bounded: drops a quarter of it, where the front moved least, but
/// never two neighbours and nothing of the newest quarter. So a front that stands open for hours costs no more than one
/// that moves, and its motions stay. Rare by construction (every limit / 4 observations). Returns whether it dropped any.
bool thinOut(std::vector<TrackedObservation>& history, int limit);

}  // namespace cabinet_articulation::core
