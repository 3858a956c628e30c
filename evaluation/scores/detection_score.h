// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/rectangles/detected_rectangle.h"
#include "sources/frame_source.h"

namespace cabinet_articulation::core::evaluation {

/// True where a front can be told apart from what surrounds it: its moving edge 3 cm out, half of it visible, inside the
/// image and seen from its front side. A closed front is coplanar with its neighbours.
bool canBeDetected(const Front& front);

/// The rectangle that overlaps a true front best, against that front.
struct DetectionScore {
  int best = -1;           ///< index of that rectangle; -1: none overlaps, the other numbers are meaningless
  bool detected = false;   ///< IoU >= 0.8, offset along the normal <= 3 cm, normals within 6 degrees
  double iou = 0;          ///< in the true front's plane
  double center = 0;       ///< [m] distance of the centres
  double offset = 0;       ///< [m] the same along the true normal
  double normal = 0;       ///< [rad] angle of the normals
  double in_plane = 0;     ///< [rad] angle of the sides, 0..pi/4
  double orientation = 0;  ///< [rad] angle of the whole rotation
  double width = 0;        ///< [m] measured minus true
  double height = 0;       ///< [m]
};

DetectionScore scoreDetection(const Rectangle& truth, const std::vector<DetectedRectangle>& rectangles);

}  // namespace cabinet_articulation::core::evaluation
