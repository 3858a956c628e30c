// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <articulation_msgs/ArticulatedObjectMsg.h>

#include "cabinet_articulation/articulation/articulation_config.h"

namespace cabinet_articulation::bridge {

/// How the parts of an object hang on one another, as get_spanning_tree of the original release: a model of each pair of parts,
/// and the tree from part 0 on whose joints have the least BIC. Fills `models`, with ids from * parts + to and the way of `to` as
/// `from` sees it, and pose_projected of the parts. Throws std::invalid_argument for less than 2 or more than 20 parts, and for
/// more poses of all pairs than kMostFittedPoses. The same for parts with different numbers of poses, and for what a fit refuses.
articulation_msgs::ArticulatedObjectMsg spanningTree(articulation_msgs::ArticulatedObjectMsg object,
                                                     const core::ArticulationConfig& config);

}  // namespace cabinet_articulation::bridge
