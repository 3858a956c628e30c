// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/planes/plane_region.h"
#include "cabinet_articulation/stereo/depth_frame.h"
#include "rectangles/chart/image_edge.h"

namespace cabinet_articulation::core {

/// True if the surface bends away from the plane along this edge, as bottles, bins and arms do (ours): it has begun to leave
/// the plane inside the edge, and beyond it has not left it by a step. A rectangle on a round thing ends where a tolerance
/// ends; that is no edge. Nor is the hinge of a door that has just opened: its neighbour leaves the door's plane so slowly
/// that nobody can say where.
bool bendsAway(const DepthFrame& frame, const DisparityPlane& plane, const ImageEdge& edge);

}  // namespace cabinet_articulation::core
