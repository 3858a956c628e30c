// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "articulation/decision/candidate.h"
#include "articulation/decision/motion_detection.h"

namespace cabinet_articulation::core {

/// Which candidate describes the track, and how sure that is.
struct Selection {
  std::size_t best = 0;               ///< of the candidates given
  std::vector<double> probabilities;  ///< index = JointType; sums to 1
  double log_odds = 0;                ///< [nats] of the best model that moves against one that does not, by likelihood alone
  bool moved = false;                 ///< a model that moves is more probable, and the motion is no jitter
  bool explained = true;              ///< false: moved, but no candidate describes how
};

/**
 * The best model, Eq. (11), in two steps (ours). Residuals of real tracks follow one another strongly: taken as independent, they
 * make every millimetre of bow a door (measured on 105 real logs).
 *
 * Between models that move, residuals are a sequence with correlated steps (ArticulationModel::sequenceLogLikelihood). Poses may
 * not say how certain they are. Then a model whose path bends by less than sagitta_min, and on which the front hardly turns, is
 * not preferred to a simpler one. Between rigid and moving, residuals are taken as independent, since a correlated sequence
 * explains slow motion by itself. There the likelihood counts for as many poses as are independent. The motion must also pass
 * `detector` and have `log_odds` [nats], or be evident to `detector`. Where `detector` is null, it is known that the front moves.
 * Residuals are also independent between a joint that does not explain the motion and a curve of any shape.
 */
Selection selectModel(std::vector<Candidate>* candidates, const PoseSequence& track, const MotionDetector* detector,
                      double log_odds, const ArticulationConfig& config);

}  // namespace cabinet_articulation::core
