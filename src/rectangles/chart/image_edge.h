// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "rectangles/chart/plane_chart.h"

namespace cabinet_articulation::core {

constexpr std::array<Edge, 4> kEdges{{kEdgeMinusX, kEdgePlusX, kEdgeMinusY, kEdgePlusY}};

/// [m] How far each edge that ends at a crease may go on behind it, in the order of `Edge`. Nothing for the others.
using HiddenBehind = std::array<std::optional<double>, 4>;

/// The axis an edge is perpendicular to: 0 (x, the edge is `height` long) or 1 (y, the edge is `width` long).
inline int edgeAxis(Edge edge) { return edge == kEdgeMinusX || edge == kEdgePlusX ? 0 : 1; }

/// One edge of a rectangle in the left image.
struct ImageEdge {
  Eigen::Vector2d a, b;         ///< [px] its ends, counter-clockwise about the rectangle as seen from its normal's side
  Eigen::Vector2d outward;      ///< unit, perpendicular to the edge in the image
  double depth = 0;             ///< [px] from the opposite edge's middle to this edge
  double metres_per_pixel = 0;  ///< how far the edge moves in the plane when its middle moves by one pixel along `outward`

  /// [px] The place at this share of its length, `offset` outward.
  Eigen::Vector2d at(double share, double offset) const { return a + share * (b - a) + offset * outward; }
};

/// Pixels about an edge that are looked at.
struct EdgeBand {
  ImageQuad quad;
  bool upright;  ///< the edge crosses rows rather than columns
  int stride;    ///< of the rows or columns that it crosses: a long edge has more pixels than are needed
};

/// From `inside` to `outside` [px] of an edge, without its ends, in an image whose longer side has `longest` pixels.
EdgeBand bandAbout(const ImageEdge& edge, double inside, double outside, int longest);

/// Nothing for an edge that is behind the camera or shorter than a pixel.
std::optional<ImageEdge> imageEdge(const PlaneChart& chart, const PlaneRectangle& rectangle, Edge edge);

}  // namespace cabinet_articulation::core
