// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "cabinet_articulation/articulation/furniture_prior.h"
#include "cabinet_articulation/config/config.h"

namespace cabinet_articulation::core {

/// "measured" below: on 105 logs of real doors and drawers whose types are known.
struct ArticulationConfig {
  std::string joint_types = "all";

  double sigma_position = 0.01;
  double sigma_orientation = 0.1;
  double sigma_edge = 0.02;
  double sigma_plane = 0.003;
  double degrees_of_freedom = 5;
  double sigma_position_floor = 0.001;
  double sigma_orientation_floor = 0.14;
  double radius_min = 0.02;
  double radius_max = 1.2;
  double marker_radius_max = 2.5;

  double sequence_degrees_of_freedom = 3;
  double sagitta_min = 0.006;
  double turn_min = 0.1;
  double motion_min = 0.03;
  double motion_to_noise = 6;
  double motion_to_jitter = 10;
  double edge_support_min = 0.5;
  int observations_min = 2;
  double outlier_share_max = 0.3;
  double deviation_max = 2;
  double covariance_factor = 2.6;

  bool use_orientation = true;
  int poses_max = 200;
  int sequence_poses_max = 320;
  int seed = 1;

  FurniturePrior prior;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("joint_types", self.joint_types, Choices{},
          "candidates: all, or the names of some (doc/conventions.md) with spaces between");
    visit("sigma_position", self.sigma_position, Range{1e-4, 1}, "m", "position noise of Eq. (9) (original release: 0.01)");
    visit("sigma_orientation", self.sigma_orientation, Range{1e-3, 100}, "rad",
          "orientation noise of Eq. (9) (original release: 0.1 with a camera)");
    visit("sigma_edge", self.sigma_edge, Range{0, 1}, "m",
          "error of a front's place within its plane that its edges share over a track (measured: up to 0.02)");
    visit("sigma_plane", self.sigma_plane, Range{1e-4, 1}, "m",
          "error of a front's place across its plane, at its edges too, which deviations are weighed against (measured)");
    visit("degrees_of_freedom", self.degrees_of_freedom, Range{1, 1000}, "",
          "tails of the noise when parameters are fitted (Student's t; measured: 5, large is Gaussian)");
    visit("sigma_position_floor", self.sigma_position_floor, Range{1e-6, 0.1}, "m",
          "smallest noise a fit may believe in (measured)");
    visit("sigma_orientation_floor", self.sigma_orientation_floor, Range{1e-3, 100}, "rad",
          "the same for orientations, whose errors are systematic: less biases the radius (measured)");
    visit("radius_min", self.radius_min, Range{1e-3, 1}, "m", "smallest distance of an axis from the observed point");
    visit("radius_max", self.radius_max, Range{0.05, 10}, "m",
          "largest one of a front whose size is known (measured: 1.0 to 1.2)");
    visit("marker_radius_max", self.marker_radius_max, Range{0.05, 10}, "m",
          "largest one of a marker: where it is bound, bowed drawers look like wide doors, which are rare beforehand (measured)");
    visit("sequence_degrees_of_freedom", self.sequence_degrees_of_freedom, Range{1, 1000}, "",
          "tails of the innovations when prismatic and rotational are compared (measured: 2 to 5)");
    visit("sagitta_min", self.sagitta_min, Range{0, 0.1}, "m",
          "an arc that bends less than this is never preferred to a line (measured: slip of a gripper looks like 6 mm)");
    visit("turn_min", self.turn_min, Range{0, 3}, "rad",
          "unless the front was seen to turn by this much along it (ours: a door's face tells before its path bends); for poses "
          "that "
          "do not say how certain they are");
    visit("motion_min", self.motion_min, Range{0, 1}, "m", "shorter paths are not motion yet (ours)");
    visit("motion_to_noise", self.motion_to_noise, Range{0, 100}, "",
          "nor are paths shorter than this many times the spread across them, as slow jitter makes them (ours)");
    visit(
        "motion_to_jitter", self.motion_to_jitter, Range{0, 100}, "",
        "nor shorter than this many times the jitter from one pose to the next (measured: real motions 15 and more, mostly 100)");
    visit("edge_support_min", self.edge_support_min, Range{0, 1}, "",
          "share of its edges that the median observation of a front sees; with less, a motion must stand out more "
          "(measured: fronts 0.57 and more, clutter 0.45)");
    visit("observations_min", self.observations_min, Range{2, 1000}, "",
          "fewer poses than this do not show motion; two can where they say how certain they are (ours)");
    visit("outlier_share_max", self.outlier_share_max, Range{0.01, 1}, "",
          "no model explains a track with more poses than this farther than 3 sigma_position from it (measured)");
    visit("deviation_max", self.deviation_max, Range{0.1, 100}, "",
          "nor one whose poses are more than this many sigma_position from it in the mean "
          "(measured: joints up to 1.4, other motions from 2.7)");
    visit("covariance_factor", self.covariance_factor, Range{0.1, 100}, "",
          "on covariances, beyond the correction for correlated noise (measured, so that 95 % intervals hold 90 to 98 %)");
    visit("use_orientation", self.use_orientation, "false: positions only");
    visit("poses_max", self.poses_max, Range{10, 100000}, "",
          "poses a fit uses at most, evenly spaced (measured: 100 to 200 are safe)");
    visit("sequence_poses_max", self.sequence_poses_max, Range{10, 100000}, "",
          "poses the comparison of prismatic and rotational uses at most, in runs; less costs right answers (measured)");
    visit("seed", self.seed, Range{0, 2147483647}, "", "seed of the consensus that starts the fits");
    FurniturePrior::fields(self.prior, visit);
  }
};

}  // namespace cabinet_articulation::core
