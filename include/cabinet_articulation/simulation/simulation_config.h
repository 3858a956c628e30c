// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/config/config.h"

namespace cabinet_articulation::core {

/// The simulated rig and what it looks at. The defaults describe a small active stereo head like the paper's (II, III-A):
/// a random grid of squares, a projector beside the cameras with a similar focal length, 640x480 at 15 Hz.
struct SimulationConfig {
  std::string scene = "kitchen";
  int scene_seed = 1;
  std::string hinge = "left";
  bool hand = true;
  double camera_motion = 0;
  int rounds = 1;
  bool loop = false;

  double rate = 15;
  int width = 640;
  int height = 480;
  double focal_length = 690;
  double baseline = 0.09;

  int pattern_seed = 1;
  double pattern_cell = 3.4;
  double pattern_blur = 0.15;
  bool shadows = true;
  double ambient = 0.08;

  double lens_blur = 0.45;
  double vignetting = 0.35;
  double target_brightness = 55;
  double max_gain = 8;
  double full_well = 12000;
  double read_noise = 28;
  int noise_seed = 1;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("scene", self.scene, Choices{"door", "drawer", "kitchen", "pedestal", "bifold", "trolley", "cupboard", "static"},
          "what stands in front of the camera");
    visit("scene_seed", self.scene_seed, Range{0, 1e6}, "", "varies sizes, view, materials and speeds by some per cent");
    visit("hinge", self.hinge, Choices{"left", "right"}, "side of the door's hinge, seen from the room");
    visit("hand", self.hand, "an arm and a hand in front of the handle of what moves");
    visit("camera_motion", self.camera_motion, Range{0, 0.3}, "m", "how far the camera wanders about its place; 0: it stands");
    visit("rounds", self.rounds, Range{1, 1000}, "",
          "how often everything opens in one run; from the second time on each to a width and after a rest of its own");
    visit("loop", self.loop, "start the motion again after its end; otherwise the last state stays");
    visit("rate", self.rate, Range{0.1, 200}, "Hz", "frames per second (paper, III-A: 15)");
    visit("width", self.width, Range{16, 4096}, "px", "image width");
    visit("height", self.height, Range{16, 4096}, "px", "image height");
    visit("focal_length", self.focal_length, Range{50, 10000}, "px", "focal length (50 degrees at 640 px, paper III-A: 690)");
    visit("baseline", self.baseline, Range{0.005, 1}, "m", "distance of the two cameras");
    visit("pattern_seed", self.pattern_seed, Range{0, 1e6}, "", "seed of the projected grid");
    visit("pattern_cell", self.pattern_cell, Range{1.5, 40}, "px", "side of a projected square, as the cameras see it");
    visit("pattern_blur", self.pattern_blur, Range{0, 1}, "", "defocus of the projector (sigma) in squares");
    visit("shadows", self.shadows, "objects cast shadows into the projected pattern");
    visit("ambient", self.ambient, Range{0, 10}, "", "room light relative to a white square of the projector at 1 m");
    visit("lens_blur", self.lens_blur, Range{0, 5}, "px", "blur of the cameras (sigma)");
    visit("vignetting", self.vignetting, Range{0, 0.9}, "", "share of the light lost in the image corners");
    visit("target_brightness", self.target_brightness, Range{5, 200}, "", "mean grey value the automatic gain aims at");
    visit("max_gain", self.max_gain, Range{1, 64}, "", "largest automatic gain");
    visit("full_well", self.full_well, Range{100, 1e6}, "e-", "electrons of a white pixel at gain 1; sets the shot noise");
    visit("read_noise", self.read_noise, Range{0, 1000}, "e-", "noise of a dark pixel (standard deviation)");
    visit("noise_seed", self.noise_seed, Range{0, 1e6}, "", "seed of the sensor noise");
  }
};

}  // namespace cabinet_articulation::core
