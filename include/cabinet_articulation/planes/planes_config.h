// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "cabinet_articulation/config/config.h"

namespace cabinet_articulation::core {

/// Tolerances are pairs: the larger of a number of pixels and a distance along the ray, turned into pixels where it is
/// measured, but never more than `tolerance_cap`. Block matching errs by a constant number of pixels, while surfaces and
/// calibrations are bent by millimetres.
struct PlanesConfig {
  std::string method = "local";
  int seed = 1;

  int stride = 4;  ///< [px]
  int hypotheses = 200;
  double confidence = 0.99;
  int min_inliers = 50;
  int max_planes = 30;
  double tolerance_cap = 2;        ///< [px]
  double fit_tolerance_px = 0.35;  ///< [px]
  double fit_tolerance_m = 0.006;  ///< [m]
  double plane_distance = 0.02;    ///< [m]

  double region_tolerance_px = 0.5;   ///< [px]
  double region_tolerance_m = 0.008;  ///< [m]
  int min_region = 400;               ///< [px]
  int max_regions = 60;
  double duplicate_overlap = 0.5;

  bool refine = true;
  bool bend = true;
  int refine_iterations = 6;
  int refine_pixels = 6000;
  double refine_max_shift = 1.5;  ///< [px]

  double mask_tolerance_px = 0.8;    ///< [px]
  double mask_tolerance_m = 0.008;   ///< [m]
  double other_plane_margin = 0.15;  ///< [px]

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("method", self.method, Choices{"local", "paper"},
          "local: the whole recipe; paper: whole planes within plane_distance, nothing else (III-B.1)");
    visit("seed", self.seed, Range{0, 2147483647}, "", "seed of the random samples");
    visit("stride", self.stride, Range{1, 32}, "px", "RANSAC sees every stride-th pixel in both directions");
    visit("hypotheses", self.hypotheses, Range{1, 100000}, "", "most samples drawn for one plane");
    visit("confidence", self.confidence, Range{0.5, 0.999999}, "",
          "fewer samples are drawn once a better plane is less likely than 1 minus this");
    visit("min_inliers", self.min_inliers, Range{3, 1000000}, "", "fewest of the strided pixels that make a plane");
    visit("max_planes", self.max_planes, Range{1, 1000}, "", "most planes in a frame");
    visit("tolerance_cap", self.tolerance_cap, Range{0.01, 100}, "px",
          "upper limit of all tolerances below: near surfaces stay apart");
    visit("fit_tolerance_px", self.fit_tolerance_px, Range{0.01, 100}, "px", "RANSAC: an inlier is this near to the plane");
    visit("fit_tolerance_m", self.fit_tolerance_m, Range{0, 1}, "m", "or this near");
    visit("plane_distance", self.plane_distance, Range{0.0001, 1}, "m", "the paper's d of Eqs. (1) and (2); method paper only");
    visit("region_tolerance_px", self.region_tolerance_px, Range{0.01, 100}, "px", "a region's pixel is this near to its plane");
    visit("region_tolerance_m", self.region_tolerance_m, Range{0, 1}, "m", "or this near");
    visit("min_region", self.min_region, Range{16, 1000000}, "px", "smallest connected region");
    visit("max_regions", self.max_regions, Range{1, 1000}, "", "the largest regions are kept");
    visit("duplicate_overlap", self.duplicate_overlap, Range{0.05, 1}, "",
          "a region that shares this part of its pixels with a larger one is a duplicate, if the planes agree");
    visit("refine", self.refine, "refine each region's plane on the two images");
    visit("bend", self.bend, "learn by how much a depth camera bends what is flat, and take it away");
    visit("refine_iterations", self.refine_iterations, Range{1, 50}, "", "most Gauss-Newton steps");
    visit("refine_pixels", self.refine_pixels, Range{100, 1000000}, "", "most pixels of a region that are compared");
    visit("refine_max_shift", self.refine_max_shift, Range{0.01, 100}, "px",
          "a refinement that moves the plane further inside the region is rejected");
    visit("mask_tolerance_px", self.mask_tolerance_px, Range{0.01, 100}, "px",
          "mask: an in-plane pixel is this near to the plane");
    visit("mask_tolerance_m", self.mask_tolerance_m, Range{0, 1}, "m", "or this near");
    visit("other_plane_margin", self.other_plane_margin, Range{0, 10}, "px",
          "an in-plane pixel of another region is other-plane if it is nearer to that plane by this");
  }
};

}  // namespace cabinet_articulation::core
