// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "sources/track_source.h"

namespace cabinet_articulation::core::evaluation {

/// How far a model's nearest prediction is from where the front really was, in the mean.
struct PredictionError {
  double position = 0;      ///< [m] of the centres
  double position_max = 0;  ///< [m] the largest instead of the mean
  double orientation = 0;   ///< [rad] the front's eight descriptions count as one
};

/// The opening of each pose is not given: what counts is the prediction that explains the pose best, Eq. (9) (the error of the
/// model, not of q). Openings up to five times those the model has seen are tried. Without `with_orientation` the poses are
/// mere positions, and the error of the orientation says nothing.
PredictionError predictionError(const LearnedModel& model, const std::vector<ReferencePose>& truth, bool with_orientation = true);

}  // namespace cabinet_articulation::core::evaluation
