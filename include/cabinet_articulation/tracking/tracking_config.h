// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/config/config.h"

namespace cabinet_articulation::core {

/// Settings of the tracker: what continues a track, when it ends, and how certain edges and sizes are.
struct TrackingConfig {
  double timeout = 20;
  double tentative_timeout = 1;
  int confirmed_after = 3;
  double min_presence = 0.6;
  double position_tolerance = 0.03;
  double angle_tolerance = 0.39;
  double twist_tolerance = 0.25;
  double size_tolerance = 0.015;
  double first_size_sigma = 0.05;
  double max_speed = 1;
  double max_turn_rate = 3;
  double prediction_horizon = 0.3;
  double edge_sigma = 0.002;
  double unseen_edge_sigma = 0.2;
  int max_observations = 1000;
  int max_ended_tracks = 64;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("timeout", self.timeout, Range{0.1, 1e6}, "s", "a track that was not seen for this long ends (original release: 20)");
    visit("tentative_timeout", self.tentative_timeout, Range{0, 1e6}, "s",
          "the same for a track that is not confirmed yet (ours: clutter flickers)");
    visit("confirmed_after", self.confirmed_after, Range{1, 1000}, "", "observations that confirm a track");
    visit("min_presence", self.min_presence, Range{0, 1}, "",
          "a young track that is seen in fewer of its frames ends; longer absences count as three frames (ours: arms and "
          "pieces of corners flicker, fronts are seen in nearly every frame)");
    visit("position_tolerance", self.position_tolerance, Range{0.001, 10}, "m",
          "jump along the front's plane that still is the same front (original release: 0.20 in every direction)");
    visit("angle_tolerance", self.angle_tolerance, Range{0.01, 3.2}, "rad",
          "jump of the normal that still is the same front (original release: pi / 8)");
    visit("twist_tolerance", self.twist_tolerance, Range{0.01, 0.7}, "rad",
          "turn about the normal that still is the same front (ours: fronts do not turn that way)");
    visit("size_tolerance", self.size_tolerance, Range{0.001, 10}, "m",
          "deviation from the track's size, beside that size's own uncertainty (original release: 0.03 to 0.05)");
    visit("first_size_sigma", self.first_size_sigma, Range{0.001, 10}, "m",
          "uncertainty of a size seen once; barely open doors appear 0.03 to 0.12 too wide (ours, measured)");
    visit("max_speed", self.max_speed, Range{0.01, 100}, "m/s", "fastest pull along the normal while a front is not seen");
    visit("max_turn_rate", self.max_turn_rate, Range{0.01, 100}, "rad/s", "fastest swing of a door while it is not seen");
    visit("prediction_horizon", self.prediction_horizon, Range{0, 10}, "s",
          "a motion is extrapolated for this long at constant velocity");
    visit("edge_sigma", self.edge_sigma, Range{1e-4, 0.1}, "m",
          "error of an edge that was observed along four fifths or more (measured: 1 to 3 mm)");
    visit("unseen_edge_sigma", self.unseen_edge_sigma, Range{1e-3, 10}, "m",
          "error of an edge that was not observed (measured: up to 0.2 where a closed neighbour continues the front)");
    visit("max_observations", self.max_observations, Range{16, 10000}, "",
          "a longer history is thinned out where the front moved least");
    visit("max_ended_tracks", self.max_ended_tracks, Range{0, 10000}, "",
          "fronts that get their id back when they return after their timeout; those that moved least are forgotten first");
  }
};

}  // namespace cabinet_articulation::core
