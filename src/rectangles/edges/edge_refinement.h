// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cabinet_articulation/rectangles/rectangles_config.h"
#include "rectangles/edges/edge_profile.h"

namespace cabinet_articulation::core {

/// A rectangle on the edges that the images show.
struct RefinedRectangle {
  PlaneRectangle rectangle;
  std::array<bool, 4> confirmed{{false, false, false, false}};  ///< edges that the images place, in the order of `Edge`
  std::array<bool, 4> placed{{false, false, false, false}};     ///< the same, or by depth
  HiddenBehind hidden;
};

/// Where a rectangle lies.
struct Surroundings {
  const DepthFrame& frame;
  const std::vector<PlaneRegion>& regions;  ///< all of the frame
};

/// Moves each edge to where the two images stop agreeing on the plane, and turns the rectangle to suit both halves of its
/// edges (ours: block matching draws edges 1-5 mm too far out or in, and the sign depends on the scene). An edge without
/// contrast stays where it is, or goes to where its plane meets its neighbour's. Without images, depth places the edges
/// (DepthEdge).
RefinedRectangle refineEdges(const PlaneChart& chart, const PlaneRegion& region, const Surroundings& surroundings,
                             const PlaneRectangle& rectangle, const RectanglesConfig& config);

}  // namespace cabinet_articulation::core
