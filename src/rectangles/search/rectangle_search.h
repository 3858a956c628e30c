// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rectangles/search/rectangle_objective.h"

namespace cabinet_articulation::core {

/// What the search may change.
enum class SearchFreedom { kAll, kPlacement };  ///< kPlacement: position and angle, the size is given

/// The best rectangle found.
struct SearchResult {
  PlaneRectangle rectangle;
  double gain = 0;  ///< of the objective; minus infinity if not even the start was allowed
};

/// Paper III-B.2: the greedy search for the best rectangle. From large steps to small ones, tries to move each edge,
/// to turn and to shift, and keeps what gains; a step that gains is repeated. Steps are in metres; a turn's step is the
/// one that moves the far corners by about as much.
SearchResult searchRectangle(const PlaneChart& chart, const RectangleObjective& objective, const PlaneRectangle& start,
                             SearchFreedom freedom, const RectanglesConfig& config);

}  // namespace cabinet_articulation::core
