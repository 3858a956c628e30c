// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/stereo/depth_frame.h"
#include "rectangles/chart/rectangle_candidate.h"

namespace cabinet_articulation::core {

/// Fits the plane of a candidate to the depth within its rectangle, by least squares without outliers (ours). The region of a
/// front that turns about a hinge has a part of its neighbour, too. It lacks pixels of the front that the neighbour's plane
/// explains better. Both tilt the plane. The rectangle keeps its corners in the image. False, and nothing changes, if there is
/// too little depth.
bool refitByDepth(const DepthFrame& frame, RectangleCandidate* candidate);

}  // namespace cabinet_articulation::core
