// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/tracking/track.h"
#include "structure/carrier_path.h"

namespace cabinet_articulation::core {

/// The observations of one front in the world, and the same as seen from the centre of another front.
struct TrackPair {
  Track world, relative;
  /// [m] The widest way that the other front's corners went while this one was observed.
  double carrier_way = 0;
};

/// The observations of `child` at times when it is known where the carrier was. Covariances are those in the world, so that the
/// carrier's noise counts against it.
TrackPair relativeTo(const CarrierPath& carrier, const Track& child);

/// Adds, in the order of stamps, where the child was while it was closed, and could not be told from the carrier. `joint` is how
/// the child moves in the world. Adds nothing unless the child closes into the carrier's plane and outline, to within `margin`
/// [m].
void addSeenAsPart(const CarrierPath& carrier, const Track& carrier_track, const LearnedModel& joint, double margin,
                   TrackPair* pair);

}  // namespace cabinet_articulation::core
