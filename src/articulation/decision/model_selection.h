// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "articulation/decision/motion_detection.h"
#include "articulation/models/articulation_model.h"

namespace cabinet_articulation::core {

/// A fitted model with what selection found out about it.
struct Candidate {
  ArticulationModel* model = nullptr;
  ModelResiduals residuals;
  double log_likelihood = 0;  ///< Eq. (10)
  /// The same as if planes that report how certain they are erred by sigma_position, not sigma_plane: those that stand still
  /// do while they take in parts of what comes out of them.
  double cautious_log_likelihood = 0;
  double evidence = 0;        ///< of models that move: sequence log-likelihood less the penalty for complexity
  double correlation = 0;     ///< of one position residual with the next
  double memory = 0;          ///< correlation with the next of a sequence whose mean is as uncertain as that of the residuals
  double outlier_share = 0;   ///< poses farther than 3 standard deviations
  double mean_deviation = 0;  ///< of the poses, in standard deviations
  bool plausible = true;      ///< false: no joint of this front can be there, so that nothing moves that looks like it
};

/// Which candidate describes the track, and how sure that is.
struct Selection {
  std::size_t best = 0;               ///< of the candidates given
  std::vector<double> probabilities;  ///< index = JointType; sums to 1
  double log_odds = 0;                ///< [nats] of the best model that moves against one that does not, by likelihood alone
  bool moved = false;                 ///< a model that moves is more probable, and the motion is no jitter
  bool explained = true;              ///< false: moved, but no candidate describes how
};

/// Residuals and likelihoods of a fitted model.
Candidate evaluateCandidate(ArticulationModel* model, const PoseSequence& track, const ArticulationConfig& config);

/// Whether the track is what this model says, but for some poses. The noise of real tracks is slow, so that no less than
/// centimetres tell.
bool explains(const Candidate& candidate, const ArticulationConfig& config);

/**
 * The best model, Eq. (11), in two steps, because residuals of real tracks follow one another so strongly that as
 * independent ones they make every millimetre of bow a door (ours; measured on 105 real logs).
 *
 * Between models that move, residuals are a sequence with correlated steps (ArticulationModel::sequenceLogLikelihood). Where
 * poses do not say how certain they are, a model whose path bends by less than sagitta_min, and on which the front hardly
 * turns, is not preferred to a simpler one. Between rigid and moving they are not, since such a sequence explains slow motion
 * by itself: there they are independent, the likelihood counts for as many poses as are independent, and the motion must pass
 * `detector` and have `log_odds` [nats], or be evident to it, unless it is null: then it is known that the front moves. So they
 * are between a joint that does not explain the motion and a curve of any shape.
 */
Selection selectModel(std::vector<Candidate>* candidates, const PoseSequence& track, const MotionDetector* detector,
                      double log_odds, const ArticulationConfig& config);

}  // namespace cabinet_articulation::core
