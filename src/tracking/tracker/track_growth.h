// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tracking/matching/track_memory.h"

namespace cabinet_articulation::core {

/// A track of one observation, as detected; without an id.
Track startOfTrack(double stamp, const DetectedRectangle& detection);

/// Adds a detection that continues the track (findContinuation). With a better size all observations are placed anew, and the
/// revision counts one more.
void append(double stamp, const DetectedRectangle& detection, const TrackingConfig& config, Track* track, TrackMemory* memory);

}  // namespace cabinet_articulation::core
