// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "cabinet_articulation/config/config.h"

namespace cabinet_articulation::core {

/// Settings of the detector: the objective, the search, the refinement and what is accepted.
struct RectanglesConfig {
  // Objective
  std::string objective = "label_weights";
  double weight_free = -6;
  double weight_other_plane = -2;
  double weight_occluded = -0.05;
  double weight_unknown = -0.2;
  double alpha = 0.05;
  double cost_occluded = 0.2;
  double cost_unknown = 0.2;
  // Search
  int random_starts = 0;
  int seed = 1;
  double first_step = 0.12;
  double last_step = 0.001;
  // Refinement on the images
  bool refine_planes = true;
  bool refine_edges = true;
  double edge_contrast = 1;
  double edge_agreement = 0.5;
  // Acceptance
  double min_precision = 0.85;
  double min_recall = 0.7;
  double min_visible = 0.4;
  double min_observed_edges = 2;
  double min_observed_across = 0.4;
  double min_side = 0.06;
  double max_side = 2.4;
  // Tracks
  bool use_tracks = true;
  double track_gain = 0.6;
  // Budget
  int max_rectangles = 20;
  double time_budget = 0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("objective", self.objective, Choices{"label_weights", "paper"},
          "label_weights: sum of a weight per pixel (ours: no single alpha serves doors and drawers); paper: Eq. (3) as in the "
          "original release");
    visit("weight_free", self.weight_free, Range{-100, 0}, "", "gain of a free pixel, where an in-plane pixel gains 1 (ours)");
    visit("weight_other_plane", self.weight_other_plane, Range{-100, 0}, "",
          "gain of a pixel that belongs to another region (ours)");
    visit("weight_occluded", self.weight_occluded, Range{-100, 0}, "",
          "gain of an occluded pixel (ours: less splits a front behind a hand, more grows it behind its neighbours)");
    visit("weight_unknown", self.weight_unknown, Range{-100, 0}, "", "gain of a pixel without depth or outside the image (ours)");
    visit("alpha", self.alpha, Range{0, 1}, "", "Eq. (3): preference for large rectangles (paper: 0.05)");
    visit("cost_occluded", self.cost_occluded, Range{0, 1}, "",
          "Eqs. (3) and (4): cost of an occluded pixel (paper, Fig. 5: 0.2)");
    visit("cost_unknown", self.cost_unknown, Range{0, 1}, "",
          "Eqs. (3) and (4): cost of a pixel without depth (paper, Fig. 5: 0.2)");
    visit("random_starts", self.random_starts, Range{0, 100}, "",
          "searches from random places in each region, beside the one from its outline (paper: several; ours: the outline "
          "suffices)");
    visit("seed", self.seed, Range{0, 2147483647}, "", "seed of the random starts");
    visit("first_step", self.first_step, Range{0.001, 1}, "m",
          "first step of the search (ours: 12 cm crosses a hand or a handle, 3 cm does not)");
    visit("last_step", self.last_step, Range{1e-4, 0.1}, "m",
          "the search ends when its step, halved again and again, falls below this");
    visit("refine_planes", self.refine_planes,
          "refine the plane of a small rectangle on its own pixels (ours: far fronts); needs the images");
    visit("refine_edges", self.refine_edges,
          "move each edge to where left and right image stop agreeing on the plane or, without images, to where depth leaves it");
    visit("edge_contrast", self.edge_contrast, Range{0, 5}, "",
          "an edge moves only if the log of the images' disagreement on the plane rises by this much across it (ours)");
    visit("edge_agreement", self.edge_agreement, Range{-1, 1}, "",
          "an edge moves only if the images' correlation inside it is at least this (ours)");
    visit("min_precision", self.min_precision, Range{0, 1}, "",
          "Eq. (4): least share of the rectangle that agrees with it (paper: 0.7)");
    visit("min_recall", self.min_recall, Range{0, 1}, "", "Eq. (5): least share of the region inside the rectangle (paper: 0.7)");
    visit("min_visible", self.min_visible, Range{0, 1}, "",
          "least share of the rectangle's pixels that are in-plane (ours: costs below 1 accept what is mostly hidden)");
    visit(
        "min_observed_edges", self.min_observed_edges, Range{0, 4}, "",
        "edges that must have been observed, in sum over their shares; not asked where a track is, nor of a front that the image "
        "cuts if its other edges are well seen (ours: pieces of larger "
        "surfaces fill their region as well as fronts do, but end nowhere)");
    visit("min_observed_across", self.min_observed_across, Range{0, 1}, "",
          "observed share of the better one of two opposite edges, for both pairs; not asked where min_observed_edges is not "
          "(ours)");
    visit("min_side", self.min_side, Range{0.001, 10}, "m", "shortest side of a rectangle (original release: 0.05)");
    visit("max_side", self.max_side, Range{0.01, 10}, "m",
          "longest side of a rectangle: doors of larders and wardrobes (original release: 1.5)");
    visit("use_tracks", self.use_tracks, "live tracks propose their fronts (ours); false: each frame is seen on its own");
    visit("track_gain", self.track_gain, Range{0, 1}, "",
          "a fit with a track's size is used where its gain is at least this share of the free fit's (ours)");
    visit("max_rectangles", self.max_rectangles, Range{1, 1000}, "",
          "rectangles of one frame at most: live tracks first, then the best supported");
    visit("time_budget", self.time_budget, Range{0, 10000}, "ms",
          "no further region is looked at once a frame's work is worth this on one core of 2 to 3 GHz; counted, not timed, so "
          "that results repeat; live tracks first, then the largest regions; 0: no limit");
  }
};

}  // namespace cabinet_articulation::core
