// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/// Did the observation say how certain it is, and of what?
bool reportsNoise(const TrackedObservation& observation);

/// Covariance of an observation, with the errors that the observations of a track share and do not report (ours). Edges err
/// together by sigma_edge, by a side face taken along or a hinge side hidden by its neighbour. Planes err by sigma_plane at their
/// edges.
Matrix6d totalCovariance(const TrackedObservation& observation, const ArticulationConfig& config);

/// The same for weighing an observation beside the others of its track. What edges share grows with how much less certain than
/// sigma_plane they are (ours). Errors that all observations have alike bend no path, and must not hide how much better some were
/// seen. Of a front that has just opened, one edge lies somewhere on its closed neighbour.
Matrix6d weighingCovariance(const TrackedObservation& observation, const ArticulationConfig& config);

}  // namespace cabinet_articulation::core
