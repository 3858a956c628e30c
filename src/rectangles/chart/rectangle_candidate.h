// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/planes/plane_region.h"
#include "rectangles/chart/plane_chart.h"

namespace cabinet_articulation::core {

/// The rectangle of one region on its way through the stage.
struct RectangleCandidate {
  int index = 0;       ///< of the region
  PlaneRegion region;  ///< shares the mask, has no hull; its plane is refined with the rectangle
  PlaneChart chart;    ///< of that plane
  PlaneRectangle rectangle;
  bool guided = false;  ///< has the size of a track
};

}  // namespace cabinet_articulation::core
