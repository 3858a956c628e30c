// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/articulation/articulation_model.h"
#include "cabinet_articulation/articulation/motion_test.h"

namespace cabinet_articulation::core {

/// A fitted model with what selection found out about it.
struct Candidate {
  ArticulationModel* model = nullptr;
  ModelResiduals residuals;
  double log_likelihood = 0;  ///< Eq. (10)
  double evidence = 0;        ///< of models that move: sequence log-likelihood less the penalty for complexity
  double correlation = 0;     ///< of one position residual with the next
  double memory = 0;          ///< correlation with the next of a sequence whose mean is as uncertain as that of the residuals
  double outlier_share = 0;   ///< poses farther than 3 sigma_position
};

/// Which candidate describes the track, and how sure that is.
struct Selection {
  std::size_t best = 0;               ///< of the candidates given
  std::vector<double> probabilities;  ///< index = JointType; sums to 1
  bool moved = false;                 ///< a model that moves is more probable, and the motion is no jitter
  bool explained = true;              ///< false: moved, but no candidate describes how
};

/// Residuals and likelihoods of a fitted model.
Candidate evaluateCandidate(ArticulationModel* model, const PoseTrack& track, const ArticulationConfig& config);

/**
 * The best model, Eq. (11), in two steps, because residuals of real tracks follow one another so strongly that as
 * independent ones they make every millimetre of bow a door (ours; measured on 105 real logs).
 *
 * Between models that move, residuals are a sequence with correlated steps (ArticulationModel::sequenceLogLikelihood). A
 * model whose path bends by less than sagitta_min, and on which the front hardly turns, is not preferred to a simpler one.
 * Between rigid and moving they are not, since such a sequence explains slow motion by itself: there they are independent, the
 * likelihood counts for as many poses as are independent, and the motion must pass `test`. So they are between a joint
 * that does not explain the motion and a curve of any shape.
 */
Selection selectModel(std::vector<Candidate>* candidates, const PoseTrack& track, const MotionTest& test,
                      const ArticulationConfig& config);

}  // namespace cabinet_articulation::core
