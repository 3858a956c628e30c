// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "cabinet_articulation/rectangles/plane_chart.h"

namespace cabinet_articulation::core {

/// The share of each edge that was really observed, in the order of `Edge` (ours): inside it the region is seen, outside
/// it something farther away or another surface. Not observed is what lies outside the image or next to it, under an
/// occluding object, and what continues in the same plane. A place without depth outside the edge counts half: it may be
/// the shadow beyond an edge or a dark spot on the plane.
std::array<float, 4> edgeSupport(const PlaneChart& chart, const PlaneRectangle& rectangle, const cv::Mat1b& mask);

}  // namespace cabinet_articulation::core
