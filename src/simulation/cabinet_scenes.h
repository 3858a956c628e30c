// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/simulation/scene.h"
#include "cabinet_articulation/simulation/simulation_config.h"

namespace cabinet_articulation::core {

/// The scene that `config.scene` names, varied by `config.scene_seed`. Closed fronts are flush with gaps of 3-4 mm, as in
/// real kitchens: nothing but their motion tells them apart in depth.
///   door      a kitchen front, one door opens.
///   drawer    a kitchen front, one drawer opens.
///   kitchen   a kitchen front, a door and a drawer open one after the other.
///   pedestal  a free-standing office pedestal, two of its three drawers open one after the other.
///   bifold    a tall cupboard, whose door folds: the second leaf hangs on the first.
///   trolley   is pushed along by half a metre, then its two drawers open.
///   cupboard  a door opens, then a drawer behind it, which hangs on the cupboard as the door does.
///   static    the kitchen front, nothing moves.
Scene makeScene(const SimulationConfig& config);

/// A forearm and a hand that holds `grip`, reaching from `shoulder`.
std::vector<Surface> makeArm(const Eigen::Vector3d& grip, const Eigen::Vector3d& shoulder);

}  // namespace cabinet_articulation::core
