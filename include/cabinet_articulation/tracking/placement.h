// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/rectangles/detected_rectangle.h"

namespace cabinet_articulation::core {

/// Description k of a detection (see `describe`), with its edges renamed accordingly.
DetectedRectangle describe(const DetectedRectangle& detection, int k);

/// The one of the eight descriptions whose axes are nearest to those of `reference`.
DetectedRectangle alignDescription(const DetectedRectangle& detection, const Rectangle& reference);

/// Where a front of known size is, when `detection` shows it with a size of its own (ours). Along each axis the front
/// can lie anywhere between "its one edge is right" and "its other edge is right". The edge that was observed
/// (support >= min_support) decides; if both were and the sizes agree, both do; else (none was, or two that contradict
/// each other) the place nearest to `expected` is taken, so that an edge that was not seen cannot look like motion.
/// The covariance is that of the centre, widened by what the edges leave open. `expected` may be null: the middle.
DetectedRectangle placeOnObservedEdges(const DetectedRectangle& detection, const Eigen::Vector2d& size, const Rectangle* expected,
                                       double min_support);

}  // namespace cabinet_articulation::core
