// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/config/config.h"

namespace cabinet_articulation::core {

/// What is known of furniture, and of those who use it, before any of it is seen. Data outweigh all of it: these are odds, shares
/// and distributions, no limits. "furniture" below: sizes in catalogues of kitchens and appliances, rounded.
struct FurniturePrior {
  double rest_odds = 1000;
  double sigma_hinge = 0.05;
  double door_radius = 0.4;
  double door_radius_spread = 0.4;
  double drawer_share = 0.9;
  double sliding_share = 0.08;
  double direction_spread = 0.1;
  double screw_share = 0.01;
  double screw_pitch = 0.004;
  double front_side = 0.3;
  double front_side_spread = 0.5;
  double unlike_size = 0.3;
  double hand_speed = 1;
  double hand_turn_rate = 3;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Section{"What is known of furniture before any is seen. Data outweigh it."});
    visit("rest_odds", self.rest_odds, Range{1e-6, 1e9}, "",
          "odds beforehand, from a detector that sees all that stands in a room, that a front stays at rest while it is watched "
          "(ours: one of a thousand moves)");
    visit("sigma_hinge", self.sigma_hinge, Range{0, 10}, "m",
          "distance of a hinge from its front's plane and from an edge of it, which tells where it is while the front turned but "
          "little; 0: any (furniture: hinges sit within 5 cm of the edge)");
    visit(
        "door_radius", self.door_radius, Range{0.05, 10}, "m",
        "distance of a door's observed point from its hinge beyond which doors become rare (furniture: cabinets' doors are up to "
        "0.6 m wide, appliances' 0.75 m, rooms' 0.9 m)");
    visit("door_radius_spread", self.door_radius_spread, Range{0.05, 5}, "",
          "standard deviation of the logarithm of the distance beyond (from the same widths)");
    visit("drawer_share", self.drawer_share, Range{0, 1}, "",
          "share of the fronts that slide which come out along their normal (ours: most are drawers)");
    visit("sliding_share", self.sliding_share, Range{0, 1}, "",
          "share of them that slide along one of their sides; the rest goes anywhere (ours)");
    visit("direction_spread", self.direction_spread, Range{0.01, 1}, "rad",
          "standard deviation of their directions about those (measured: fits to a short way err by up to 0.15 rad)");
    visit("screw_share", self.screw_share, Range{1e-9, 1}, "", "share of screws among the joints of a household (ours)");
    visit("screw_pitch", self.screw_pitch, Range{1e-5, 1}, "m",
          "standard deviation of the pitches of screws, for each radian (furniture: 2 to 50 mm a turn of stools and vices)");
    visit("front_side", self.front_side, Range{0.01, 3}, "m",
          "longer side below which fronts become rare (furniture: drawers are 0.3 m wide and more)");
    visit("front_side_spread", self.front_side_spread, Range{0.05, 5}, "",
          "standard deviation of the logarithm of the longer side below (ours: small drawers are 0.15 to 0.3 m wide)");
    visit("unlike_size", self.unlike_size, Range{0.01, 1}, "",
          "by which share of its length something differs from a front that it was taken for (ours)");
    visit("hand_speed", self.hand_speed, Range{0.01, 10}, "m/s",
          "of the hand that moves a front (ours, as the tracker's max_speed)");
    visit("hand_turn_rate", self.hand_turn_rate, Range{0.01, 100}, "rad/s",
          "no door turns faster (ours: a hand at 1 m/s on a door of 0.33 m)");
  }
};

}  // namespace cabinet_articulation::core
