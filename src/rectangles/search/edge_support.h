// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <optional>

#include "rectangles/chart/image_edge.h"

namespace cabinet_articulation::core {

/// The share of each edge that was really observed, in the order of `Edge` (ours): inside it the region is seen, outside
/// it something farther away. Not observed is what lies outside the image or next to it, and what continues in the same plane.
/// Nor is what an object in front hides: a hand, or the neighbour that a door turns behind. Where there is no depth the place
/// counts half. Where another region of nearly the same plane follows, as at the hinge of a door just opened, it counts a
/// quarter. Beyond edges that the images `confirmed`, what continues in the plane is blur or the side of a drawer's body. An
/// edge that ends at a crease counts less the farther it may go on `hidden` behind its neighbour [m].
std::array<float, 4> edgeSupport(const PlaneChart& chart, const PlaneRectangle& rectangle, const cv::Mat1b& mask,
                                 const std::array<bool, 4>& confirmed = {}, const HiddenBehind& hidden = {});

/// Edges that mostly lie outside the image, or so near its border that nothing could be seen beyond them.
std::array<bool, 4> cutEdges(const PlaneChart& chart, const PlaneRectangle& rectangle, const cv::Size& image);

}  // namespace cabinet_articulation::core
