// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/config/config.h"

namespace cabinet_articulation::core {

/// What is believed of fronts that hang on others, before any is seen to.
struct StructureConfig {
  bool hanging = true;
  double hanging_odds = 1e-4;
  double near = 0.3;
  double pause = 0.5;
  double margin = 0.02;
  int most_pairs = 200;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Section{"Fronts that hang on others, as the second leaf of a folding door."});
    visit("hanging", self.hanging,
          "whether it is looked for fronts that hang on others; what a file says of them holds in any case");
    visit("hanging_odds", self.hanging_odds, Range{1e-9, 1}, "",
          "odds beforehand that a front hangs on a certain other one rather than on the world (ours: a kitchen has a thousand "
          "pairs, and one of ten kitchens a front that hangs on another)");
    visit("hanging_near", self.near, Range{0, 10}, "m",
          "widest gap between a front and what it hangs on (furniture: leaves touch, racks hang within a hand's breadth)");
    visit("hanging_pause", self.pause, Range{0, 10}, "s",
          "between two observations of a front that are not farther apart it is where they say, as it is while it rests (ours)");
    visit("hanging_margin", self.margin, Range{0, 0.5}, "m",
          "by which a closed front may stick out of the one that it was seen as a part of (ours: the noise of edges, twice)");
    visit("hanging_pairs", self.most_pairs, Range{1, 100000}, "",
          "pairs of near fronts that are looked at, at most (ours: 14 fronts that move)");
  }
};

}  // namespace cabinet_articulation::core
