// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "articulation/observations/pose_sequence.h"
#include "articulation/paths/arc.h"
#include "cabinet_articulation/articulation/learned_model.h"
#include "kinds/joint_kind.h"

namespace cabinet_articulation::core {

/// Puts the joint of `arc`, whose middle is where the front was first seen, in place of what was learned. Parameters that say
/// where a joint is are left out.
void describe(const Arc& arc, JointType type, const PoseSamples& samples, LearnedModel* learned);

/// Puts a joint of this shape at the front's place; `covariance` of difference(). What q means may have changed then.
void describe(const JointShape& shape, const Eigen::MatrixXd& covariance, LearnedModel* front);

/// Puts a joint of the kind at the place of a front at rest, as if it were closed. The covariance is how much joints of the kind
/// differ.
void describe(const JointKind& kind, LearnedModel* front);

}  // namespace cabinet_articulation::core
