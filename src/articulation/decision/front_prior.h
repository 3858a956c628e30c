// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "articulation/decision/candidate.h"
#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/// [nats] How much more often fronts of this size move in this way than things that an erring camera pose seems to move (ours).
/// Those go anywhere, and many are small. Drawers come out along their normal, sliding doors go along one of their sides.
/// Of joints that turn only the size counts.
double frontLogOdds(const Candidate& candidate, const Track& front, const ArticulationConfig& config);

/// [nats] The odds that the newest `count` observations are of one front, against a front and things that look like it, by their
/// sizes. Things have other sizes. Infinity where no size is known.
double oddsOfOneFront(const Track& track, std::size_t count, const FurniturePrior& prior);

}  // namespace cabinet_articulation::core
