// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/rectangles/detected_rectangle.h"

namespace cabinet_articulation::core {

/// Description k of a detection (see `describe`), with its edges renamed accordingly.
DetectedRectangle describe(const DetectedRectangle& detection, int k);

/// What is known about a front's width and height [m].
struct KnownSize {
  Eigen::Vector2d value;
  Eigen::Vector2d sigma;
};

/// Where a front of known size is, when `detection` shows it with a size of its own (ours). Edges that were observed
/// (support >= min_support) stay where they were seen, and an unobserved one follows from its opposite edge and the known
/// size. An axis without any observed edge, or with two that contradict the size, leaves a range of places open: the one
/// nearest to `expected` is taken, so that an edge that was not seen cannot look like motion, and the covariance of the
/// centre says how wide that range is. `expected` may be null: then the middle of it.
DetectedRectangle placeOnObservedEdges(const DetectedRectangle& detection, const KnownSize& size, const Rectangle* expected,
                                       double min_support);

}  // namespace cabinet_articulation::core
