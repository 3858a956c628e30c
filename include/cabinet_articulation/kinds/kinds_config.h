// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/config/config.h"
#include "cabinet_articulation/config/structure_config.h"

namespace cabinet_articulation::core {

/// What is known of kinds of joints before any is seen. Joints that are learned outweigh it.
struct KindsConfig {
  bool kinds = true;
  double turn_spread = 0.07;
  double radius_spread = 0.03;
  double side_spread = 0.1;
  double spread_joints = 6;
  double novelty = 1;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Section{"Kinds of joints. Joints that are learned outweigh what is said of them here."});
    visit("kinds", self.kinds,
          "a joint that was seen to move but little is expected to be of a kind that others have, and so is a front at rest of "
          "their size");
    visit("kind_turn_spread", self.turn_spread, Range{1e-3, 3}, "rad",
          "standard deviation of the directions of joints of one kind, as seen from their fronts (measured: 0.02 to 0.1, with "
          "how differently a robot stands before them)");
    visit("kind_radius_spread", self.radius_spread, Range{1e-3, 1}, "",
          "standard deviation of the logarithm of their radii (measured: 0.01 to 0.04, with where a front is gripped)");
    visit("kind_side_spread", self.side_spread, Range{1e-3, 1}, "",
          "standard deviation of the logarithm of their fronts' sides (ours: an edge errs by up to sigma_edge on 0.2 m)");
    visit("kind_spread_joints", self.spread_joints, Range{0.1, 1000}, "",
          "of how many joints such spreads are worth, against those that are seen in the kind (ours: a few)");
    visit("kind_novelty", self.novelty, Range{1e-6, 1e6}, "",
          "how many joints the kinds that were not seen yet count as (ours: one, as in a Chinese restaurant process)");
  }
};

/// The file articulation.yaml: how each front moves, and what others tell of it.
struct LearningConfig {
  ArticulationConfig articulation;
  KindsConfig kinds;
  StructureConfig structure;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    ArticulationConfig::fields(self.articulation, visit);
    KindsConfig::fields(self.kinds, visit);
    StructureConfig::fields(self.structure, visit);
  }
};

}  // namespace cabinet_articulation::core
