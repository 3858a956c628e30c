// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/articulation/learned_model.h"
#include "structure/track_pair.h"

namespace cabinet_articulation::core {

/// How a front moves relative to another one, and how much more likely that is than that it hangs on the world.
struct HangingEvidence {
  double log_odds = -std::numeric_limits<double>::infinity();  ///< [nats] by likelihood alone
  bool rests = false;     ///< it goes along with the other front, and never moved relative to that
  LearnedModel relative;  ///< valid where log_odds is finite
};

/**
 * Bayesian information criterion of two descriptions of the same observations, Eqs. (10) and (11). Every joint is fitted to the
 * poses in the world, and to those relative to the other front. The best of each side are compared. What the freedom of q costs,
 * Eq. (6), is left out: both sides have one degree of freedom beside that of the other front, and a short way is no evidence.
 */
HangingEvidence compareWithWorld(const TrackPair& pair, const ArticulationConfig& config);

}  // namespace cabinet_articulation::core
