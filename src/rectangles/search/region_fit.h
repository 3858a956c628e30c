// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "cabinet_articulation/planes/plane_region.h"
#include "rectangles/search/rectangle_search.h"

namespace cabinet_articulation::core {

/// The rectangle that fits one region's mask best.
struct RegionFit {
  PlaneRectangle rectangle;
  bool guided = false;  ///< has the size of a track, which the region alone would not give
};

/// Searches from the minimum-area rectangle of the region's outline and from `random_starts` seeded places. Tracks whose
/// rectangles (`expected`, left optical frame) lie in the region's plane propose their own size: such a fit takes over
/// where it explains the region about as well and the size of the free fit was not really observed, as when an arm hides
/// half of a door. `objective` must hold the region's mask. Nothing if no start was allowed.
std::optional<RegionFit> fitRegion(const PlaneRegion& region, const PlaneChart& chart, const RectangleObjective& objective,
                                   const std::vector<Rectangle>& expected, const RectanglesConfig& config);

}  // namespace cabinet_articulation::core
