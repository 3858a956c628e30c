// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/geometry/rectangle.h"
#include "cabinet_articulation/planes/plane_region.h"

namespace cabinet_articulation::core {

/// True if a track's rectangle may lie in this plane, as far as it moves between two frames and errors reach.
bool liesIn(const Plane& plane, const Rectangle& expected);

/// The indices of the regions in the order in which they deserve time (ours): first those where a live track is `expected`,
/// then the others, each by size.
std::vector<int> regionOrder(const std::vector<PlaneRegion>& regions, const StereoCamera& camera,
                             const std::vector<Rectangle>& expected);

}  // namespace cabinet_articulation::core
