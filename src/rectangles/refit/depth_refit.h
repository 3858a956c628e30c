// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/stereo/depth_frame.h"
#include "rectangles/chart/image_edge.h"
#include "rectangles/chart/rectangle_candidate.h"

namespace cabinet_articulation::core {

/// Fits the plane of a candidate to the depth within its rectangle, by least squares without outliers (ours). The region of a
/// front that turns about a hinge has a part of its neighbour, too. It lacks pixels of the front that the neighbour's plane
/// explains better. Both tilt the plane. The rectangle keeps its corners in the image. False, and nothing changes, if less
/// than half of the rectangle's pixels are on the plane: most of them might then belong to something else (ours). Holes and what
/// is behind the plane or before it are left out of that: a glass door is a frame.
bool refitByDepth(const DepthFrame& frame, RectangleCandidate* candidate);

/// The same within the refined rectangle, if an edge of it ends at a crease: the region's plane is a little the neighbour's
/// there. A size that a track gave is kept; an edge at a crease then stays, and the opposite one moves.
bool refitAtCrease(const PlaneRectangle& refined, const HiddenBehind& hidden, const DepthFrame& frame,
                   RectangleCandidate* candidate);

}  // namespace cabinet_articulation::core
