// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "kinds/joint_kind.h"
#include "kinds/shape_fit.h"

namespace cabinet_articulation::core {

/// What is expected of a joint of no known kind: any direction, and the radius of a door. `direction` is what the expectation is
/// described from.
ShapePrior unknownKind(const JointShape& direction, const FurniturePrior& prior);

/// The most probable of the known kinds and a new one, for a track.
struct KindChoice {
  bool is_new = true;
  JointType type = JointType::kPrismatic;
  Arc arc;               ///< the path most probable for it; its middle is where the front was first seen
  double turns = 0;      ///< probability, over all kinds, that the joint is rotational rather than prismatic
  double advantage = 0;  ///< [nats] over a new kind
};

/// What kinds and others count for a front.
struct KindWeights {
  std::vector<double> kinds;  ///< [nats] of each
  double any = 0;             ///< [nats] of one rectangle of any size
};

/// Kinds count by their joints (Chinese restaurant process), and by how well they tell the front's size. Fronts of a new kind may
/// be as large as those of any known one. So a size speaks against kinds that do not have it, and for none. A side of 0 is
/// unknown.
KindWeights weightsOf(const std::vector<JointKind>& kinds, double width, double height);

/// `turns`: the same probability if nothing is known of kinds. Of many kinds, those that count most are tried.
KindChoice chooseKind(const std::vector<JointKind>& kinds, const KindWeights& weights, const PoseSamples& samples, double turns,
                      const KindsConfig& kinds_config, const ArticulationConfig& config);

}  // namespace cabinet_articulation::core
