// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "articulation/decision/model_selection.h"

namespace cabinet_articulation::core {

/// Where the joint is. `reference` is the observed point in the front's own frame; what is learned is that of the centre.
void describeGeometry(const Candidate& candidate, const Eigen::Vector3d& reference, LearnedModel* learned);

/// How far it was seen to move; `stamps` [s] are those of the candidate's residuals.
void describeRange(const Candidate& candidate, const std::vector<double>& stamps, LearnedModel* learned);

/// How well it fits the track of its residuals: mean errors and all parameters under the original release's names.
void describeFit(const Candidate& candidate, const PoseSequence& track, const ArticulationConfig& config, LearnedModel* learned);

}  // namespace cabinet_articulation::core
