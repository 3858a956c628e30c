// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "articulation/decision/candidate.h"

namespace cabinet_articulation::core {

/// [m] Largest distance of the observed path from its chord.
double bowOfPath(const Candidate& candidate);

/// [rad] Angle by which the front turned along the observed path.
double turnAlongPath(const Candidate& candidate);

/// [nats] Most that a joint that turns may win over one that does not (ours), where poses do not say how certain they are. Views
/// of a marker change along the way, and with them the errors of its place and its orientation. Infinity: no limit.
double largestAdvantageOfTurning(const Candidate& candidate, const Candidate& simpler, const PoseSequence& track,
                                 const ArticulationConfig& config);

/// [nats] Most that a joint that does not turn may win over one that does (ours). It is what a wide door would have bent and
/// turned by on a way of that length, beside the errors of both. Poses that say how certain they are err beyond that too: planes
/// take in parts of what comes out of them, and turn less than their front does.
double largestAdvantageOfStraightness(const Candidate& simpler, const PoseSequence& track, const ArticulationConfig& config);

}  // namespace cabinet_articulation::core
