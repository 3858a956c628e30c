// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "cabinet_articulation/kinds/joint_shape.h"

namespace cabinet_articulation::core {

/*
 * A rectangle has four descriptions from its outer side (describe()), of which a track has any. Fronts are compared in the
 * upright one: y goes up, and so x to the right as seen from before the front. Up is the fixed frame's z, which is right in
 * frames of a room. A front that faces along z, as in a camera's frame, has up against y.
 */

constexpr int kDescriptionsOfASide = 4;

/// The rotation from description 0 to k.
Eigen::Matrix3d turnOf(int k);

/// The k of describe() that makes a front with these axes upright.
int uprightDescription(const Eigen::Matrix3d& front);

/// The shape in the front's description k, for a shape in the description that k counts from.
JointShape described(const JointShape& shape, int k);

}  // namespace cabinet_articulation::core
