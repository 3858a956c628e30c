// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "articulation/decision/candidate.h"

namespace cabinet_articulation::core {

/// Where the joint is, how far it was seen to move in `track`, how certain that is and how well it fits. Parameters have the
/// names of the original release. `reference` is the observed point in the front's own frame; what is learned is that of the
/// centre. Needs LearnedModel::moved.
void describeJoint(const Candidate& candidate, const PoseSequence& track, const Eigen::Vector3d& reference,
                   const ArticulationConfig& config, LearnedModel* learned);

}  // namespace cabinet_articulation::core
