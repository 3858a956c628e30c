// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "articulation/models/articulation_model.h"

namespace cabinet_articulation::core {

/// A fitted model and what is found out about it.
struct Candidate {
  ArticulationModel* model = nullptr;
  ModelResiduals residuals;
  double log_likelihood = 0;  ///< Eq. (10)
  /// The same if planes that report how certain they are erred by sigma_position, not sigma_plane. Planes at rest do while they
  /// take in parts of what comes out of them.
  double cautious_log_likelihood = 0;
  double evidence = 0;        ///< of models that move: sequence log-likelihood less the penalty for complexity
  double correlation = 0;     ///< of one position residual with the next
  double persistence = 0;     ///< the same, or that of orientation residuals where it is larger
  double memory = 0;          ///< correlation with the next of a sequence whose mean is as uncertain as that of the residuals
  double outlier_share = 0;   ///< poses farther than 3 standard deviations
  double mean_deviation = 0;  ///< of the poses, in standard deviations
  double front_log_odds = 0;  ///< [nats] that a front moves so rather than something that only seems to move
  bool plausible = true;      ///< false: no joint of this front can be there, so that nothing moves that looks like it
};

/// Residuals and likelihoods of a fitted model.
Candidate evaluateCandidate(ArticulationModel* model, const PoseSequence& track, const ArticulationConfig& config);

/// Whether the track is what this model says, but for some poses. Only what residuals have in common with the next ones counts. A
/// motion that the model does not describe goes on from pose to pose; noise and jumps do not. The noise of real tracks is slow,
/// so that no less than centimetres tell.
bool explains(const Candidate& candidate, const ArticulationConfig& config);

/// The probability that the track is that of another motion than this model's, by the same deviations. 0 where the model explains
/// the track; where it just does not, a half, and more with larger deviations.
double probabilityOfAnother(const Candidate& candidate, const ArticulationConfig& config);

}  // namespace cabinet_articulation::core
