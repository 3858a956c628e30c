// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "rectangles/edge_profile.h"
#include "rectangles/image_edge.h"

namespace cabinet_articulation::core {

/// A front is a board, and behind it there may be a drawer's body: beyond an edge the camera may see a face that runs
/// straight back from it (ours). Its disparity leaves the front's plane so slowly that block matching carries the front
/// 6-15 mm over it.

/// [px/px] how fast, going outward from the edge, the disparity of such a face leaves that of `plane`; negative. 0 where the
/// face is turned away from the camera or too narrow in the image to matter.
double sideFaceSlope(const PlaneChart& chart, const StereoCamera& camera, const DisparityPlane& plane,
                     const PlaneRectangle& rectangle, Edge edge);

/// The strip at which a side face of this slope begins. Nothing if the plane alone explains the strips about as well.
/// `level`: the mean log residual of the plane inside.
std::optional<int> sideFaceBegin(const EdgeProfile::Residuals& residuals, double level, double slope);

}  // namespace cabinet_articulation::core
