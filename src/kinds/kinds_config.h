// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/config/config.h"

namespace cabinet_articulation::core {

/// What is known of kinds of joints before any is seen. Joints that are learned outweigh it.
struct KindsConfig {
  double turn_spread = 0.07;
  double size_spread = 0.03;
  double spread_joints = 6;
  double novelty = 1;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("turn_spread", self.turn_spread, Range{1e-3, 3}, "rad",
          "standard deviation of the directions of joints of one kind, as seen from their fronts (measured: 0.02 to 0.1, with "
          "how differently a robot stands before them)");
    visit("size_spread", self.size_spread, Range{1e-3, 1}, "",
          "standard deviation of the logarithm of their radii (measured: 0.01 to 0.04, with where a front is gripped)");
    visit("spread_joints", self.spread_joints, Range{0.1, 1000}, "",
          "of how many joints such spreads are worth, against those that are seen in the kind (ours: a few)");
    visit("novelty", self.novelty, Range{1e-6, 1e6}, "",
          "how many joints the kinds that were not seen yet count as (ours: one, as in a Chinese restaurant process)");
  }
};

}  // namespace cabinet_articulation::core
