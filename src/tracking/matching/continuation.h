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
///
/// A detection of the back is taken for a front kBoard before it, and its covariance grows by half of that along the normal. A
/// board of another thickness shifts all views of the back alike, by 4 mm for one of 22 mm. Observations have no place for an
/// error that they share, so who takes them for independent believes their mean too much.
std::optional<Continuation> findContinuation(const Track& track, const TrackMemory& memory, const DetectedRectangle& detection,
                                             double stamp, const TrackingConfig& config);

}  // namespace cabinet_articulation::core
