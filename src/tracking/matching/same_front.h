// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/tracking/track.h"
#include "cabinet_articulation/tracking/tracking_config.h"

namespace cabinet_articulation::core {

/// Two rectangles of one frame that show the same front: they overlap by a good part and lie in one plane. One of
/// the back lies kBoard behind.
bool isDuplicate(const Rectangle& a, const Rectangle& b);

/// Intersection over union of rectangles of different frames, if they are on one stretch of a surface, whatever their sizes: one
/// has half of the other's area. Else 0.
double overlapInOnePlace(const Rectangle& a, const Rectangle& b, const TrackingConfig& config);

/// A part of a front that moved, seen alone: it lies within the front's outline and plane. Closed fronts do lie in the face of
/// others.
bool isPartOf(const Track& track, const Rectangle& part, double stamp, const TrackingConfig& config);

}  // namespace cabinet_articulation::core
