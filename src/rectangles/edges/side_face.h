// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "rectangles/chart/image_edge.h"
#include "rectangles/edges/edge_profile.h"

namespace cabinet_articulation::core {

/// A front is a board, and behind it there may be a drawer's body: beyond an edge the camera may see a face that runs
/// straight back from it (ours). Its disparity leaves the front's plane so slowly that block matching carries the front
/// 6-15 mm over it.

constexpr double kLongestFace = 10;  ///< [px] that a face is followed (ours)

struct SideFace {
  double slope = 0;  ///< [px/px] of its disparity beside that of the front's plane, outward from the edge; 0: none is seen
  double width = 0;  ///< [px] of the face of a thin board
};

/// By geometry alone; none where the face is turned away from the camera or too narrow in the image to matter.
SideFace sideFace(const PlaneChart& chart, const StereoCamera& camera, const DisparityPlane& plane,
                  const PlaneRectangle& rectangle, Edge edge);

/// The strip at which a side face begins. Nothing if the plane alone explains the strips about as well.
/// `level`: the mean log residual of the plane inside.
std::optional<int> sideFaceBegin(const EdgeProfile::Residuals& residuals, double level, const SideFace& face);

}  // namespace cabinet_articulation::core
