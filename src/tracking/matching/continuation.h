// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "cabinet_articulation/tracking/track.h"
#include "cabinet_articulation/tracking/tracking_config.h"
#include "tracking/matching/track_memory.h"

namespace cabinet_articulation::core {

/// A detection seen as the next observation of a track.
struct Continuation {
  double distance = 0;         ///< [m] see motionDistance
  DetectedRectangle measured;  ///< the detection in the track's corner choice
  KnownPlace reference;        ///< the place it continues from
};

/// The nearest way in which `detection` at `stamp` [s] continues the track and what is remembered of it, or nothing. A track
/// continues from where it was last seen, from where its motion has brought it since, or (after a gap) from where it has been
/// before.
std::optional<Continuation> findContinuation(const Track& track, const TrackMemory& memory, const DetectedRectangle& detection,
                                             double stamp, const TrackingConfig& config);

}  // namespace cabinet_articulation::core
