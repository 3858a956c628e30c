// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "cabinet_articulation/joints/joint.h"

namespace cabinet_articulation::core {

/*
 * A front with a parent is described in the frame of the parent's front: its centre, x along the width, y along the height, z
 * outwards. To place it, the pose of the parent's front at its own q comes first, and so on up to the world.
 */

/// The model with this id; nullptr if there is none.
const LearnedModel* findModel(std::uint32_t id, const std::vector<LearnedModel>& models);

/// Name of the parameter that says that a front has one degree of freedom with its parent: by how much its q grows with the
/// parent's.
constexpr char kCoupledRatio[] = "coupled_ratio";

void removeCoupledRatio(LearnedModel* model);

/// The same joint, described in another frame.
LearnedModel transformed(const LearnedModel& model, const Eigen::Isometry3d& T_target_source);

/// Where the frame is that the model is described in, with all parents at their present q: the identity if it hangs on the world.
/// Throws ModelError for a parent that is not among `all` or is no joint, for a cycle, and for more than limits::kMostParents.
Eigen::Isometry3d frameOf(const LearnedModel& model, const std::vector<LearnedModel>& all);

/// Whether its parents, up to the world, are joints among `all`.
bool hangsOnKnown(const LearnedModel& model, const std::vector<LearnedModel>& all);

std::vector<LearnedModel> thoseOnKnown(const std::vector<LearnedModel>& models);

/// These and all that they hang on, as far as that is among `all`.
std::vector<LearnedModel> withParents(std::vector<LearnedModel> models, const std::vector<LearnedModel>& all);

/// The model in the frame that the world's fronts are described in, with its parents at their present q. One that hangs on the
/// world is returned as it is. Throws as frameOf().
LearnedModel placed(const LearnedModel& model, const std::vector<LearnedModel>& all);

/// The same, but from now on it hangs on the world, and stays where it is.
LearnedModel setDown(const LearnedModel& model, const std::vector<LearnedModel>& all);

/// The same of all models; those whose parents are not among them are left out.
std::vector<LearnedModel> allPlaced(const std::vector<LearnedModel>& models);

/// Those that hang on the world.
std::vector<LearnedModel> thoseOfTheWorld(const std::vector<LearnedModel>& models);

/// Throws ModelError, with the fronts in words, if they hang on one another in a cycle, or more than limits::kMostParents in a
/// row. Parents that are not among them are not looked for.
void requireNoCycle(const std::vector<LearnedModel>& models);

}  // namespace cabinet_articulation::core
