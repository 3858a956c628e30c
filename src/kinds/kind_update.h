// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/articulation/learned_model.h"
#include "kinds/joint_kind.h"
#include "kinds/kind_choice.h"

namespace cabinet_articulation::core {

/// What kinds add to a joint that its front's own poses tell already: Bayes' rule for Gaussians, in the coordinates of
/// difference().
///
/// The own estimate with its covariance is the likelihood. A kind's next joint is the prior. A joint of no known kind hangs at
/// one of the four sides of its front, or slides as FurniturePrior says. The joint stays as it is where that is more probable
/// than all known kinds, and its type in any case. Else it is the mean of the posterior of the most probable kind, with its
/// covariance. Its q are those of the same poses, and the opening stays: a share of the way. Joints without a JointShape stay as
/// they are.
LearnedModel updatedByKinds(const LearnedModel& joint, const std::vector<JointKind>& kinds, const KindWeights& weights,
                            const KindsConfig& config, const FurniturePrior& prior);

}  // namespace cabinet_articulation::core
