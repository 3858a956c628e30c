// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/rectangles/detected_rectangle.h"
#include "rectangles/search/rectangle_objective.h"

namespace cabinet_articulation::core {

/// Eq. (4): sum(1 - cost) / pixels, over the rectangle's pixels in the image. 0 without pixels.
double precision(const LabelCounts& counts, const RectanglesConfig& config);

/// Eq. (5), of the connected region and of in-plane pixels alone (ours). Over an infinite plane, flush neighbours and far-away
/// stripes count against a good front. At most 1.
double recall(const LabelCounts& counts, int region_inliers);

/// True if the size is a front's, the region fills the rectangle and the rectangle explains the region.
bool fillsRegion(const DetectedRectangle& rectangle, const LabelCounts& counts, const RectanglesConfig& config);

/// True if enough of the edges was observed to tell a front from a piece of a larger surface (ours). Where the image cuts some,
/// two opposite edges must be in view, and all in view well seen.
bool bounded(const std::array<float, 4>& edge_support, const std::array<bool, 4>& cut, const RectanglesConfig& config);

/// False if not even half of the edges that bounded() asks for is in sight before refinement, with all of them confirmed (ours).
/// Refinement moves edges by a few pixels, which makes up for less. Of 4000 fronts without a track that passed in 64 recorded and
/// rendered sequences, none had less than 0.56 of what is asked.
/// `observed_edges`: the sum of their support.
bool mayBeBounded(float observed_edges, const RectanglesConfig& config);

/// False if less than three edges were observed around a hole: that is no frame (ours).
bool framed(const DetectedRectangle& rectangle, const RectanglesConfig& config);

/// True if both show the same surface at the same place.
bool sameSurface(const Rectangle& a, const Rectangle& b);

/// A rectangle that passed, and the pixels that support it.
struct SupportedRectangle {
  DetectedRectangle detection;
  int support = 0;       ///< [px] in-plane pixels
  bool tracked = false;  ///< shows what a live track shows
};

/// Best supported first, without those that show the same surface as a better one. Of more than `max_rectangles`, tracked
/// ones stay first, then the best supported.
std::vector<DetectedRectangle> selectBest(const std::vector<SupportedRectangle>& candidates, const RectanglesConfig& config);

}  // namespace cabinet_articulation::core
