// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "cabinet_articulation/planes/plane_region.h"
#include "cabinet_articulation/rectangles/detected_rectangle.h"
#include "cabinet_articulation/stereo/depth_frame.h"
#include "rectangles/chart/plane_chart.h"

namespace cabinet_articulation::core {

/// What is known about one edge.
struct EdgeObservation {
  double support = 0;      ///< [0..1] as DetectedRectangle::edge_support
  bool confirmed = false;  ///< placed by the images rather than by the mask alone
};

/// Covariance of a rectangle's pose (as DetectedRectangle::covariance), from what was observed (ours). Observed edges
/// fix the centre and the angle within the plane; an edge that was not observed says almost nothing about where the
/// centre lies in its direction. The plane's own place and tilt follow from the in-plane pixels and the disparity's
/// noise. A depth error also shifts the centre along the line of sight. What a wrong calibration adds is not in it: that is the
/// same in every frame, so that motions are known better than places.
Matrix6d rectangleCovariance(const PlaneChart& chart, const PlaneRectangle& rectangle,
                             const std::array<EdgeObservation, 4>& edges, const PlaneRegion& region, const DepthFrame& frame);

}  // namespace cabinet_articulation::core
