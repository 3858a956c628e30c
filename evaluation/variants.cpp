// SPDX-License-Identifier: BSD-3-Clause
#include "variants.h"

namespace cabinet_articulation::core::evaluation {

Variant ourVariant() { return {"ours", {}, true}; }

Variant paperVariant() {
  Variant variant{"paper", {}, false};
  variant.config.planes.method = "paper";
  RectanglesConfig& rectangles = variant.config.rectangles;
  rectangles.objective = "paper";
  rectangles.random_starts = 10;  // the original release's launch files
  rectangles.first_step = 0.05;
  rectangles.refine_edges = false;
  rectangles.min_precision = 0.7;
  rectangles.min_recall = 0.7;
  rectangles.min_visible = 0;
  rectangles.min_side = 0.05;
  rectangles.max_side = 1.5;
  return variant;
}

}  // namespace cabinet_articulation::core::evaluation
