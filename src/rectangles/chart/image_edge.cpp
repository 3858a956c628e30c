// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/chart/image_edge.h"

#include <algorithm>
#include <cmath>

namespace cabinet_articulation::core {
namespace {

constexpr double kProbe = 0.001;  ///< [m] for the derivative of the projection

constexpr double kMargin = 0.04;       ///< share of the edge left out at either end, where the neighbouring edges begin (ours)
constexpr double kMaxDepth = 0.6;      ///< share of the rectangle's depth that may be looked at from one edge (ours)
constexpr double kEnoughPixels = 128;  ///< along the edge (ours)

/// The corners an edge runs between, by `Edge`.
constexpr int kEdgeCorners[4][2] = {{3, 0}, {1, 2}, {0, 1}, {2, 3}};

}  // namespace

std::optional<ImageEdge> imageEdge(const PlaneChart& chart, const PlaneRectangle& rectangle, Edge edge) {
  const std::optional<ImageQuad> quad = chart.project(rectangle);
  if (!quad) return std::nullopt;
  ImageEdge image;
  image.a = (*quad)[kEdgeCorners[edge][0]];
  image.b = (*quad)[kEdgeCorners[edge][1]];
  const Eigen::Vector2d along = image.b - image.a;
  if (!(along.norm() > 1)) return std::nullopt;
  const Eigen::Vector2d middle = rectangle.center + rectangle.outward(edge) * (rectangle.side(edgeAxis(edge)) / 2);
  const Eigen::Vector2d moved = (chart.toPixel(middle + kProbe * rectangle.outward(edge)) - chart.toPixel(middle)) / kProbe;
  image.outward = Eigen::Vector2d(along.y(), -along.x()).normalized();
  if (image.outward.dot(moved) < 0) image.outward = -image.outward;
  const Eigen::Vector2d opposite = rectangle.center - rectangle.outward(edge) * (rectangle.side(edgeAxis(edge)) / 2);
  image.depth = image.outward.dot(image.a - chart.toPixel(opposite));
  const double pixels_per_metre = image.outward.dot(moved);
  if (!(pixels_per_metre > 0)) return std::nullopt;
  image.metres_per_pixel = 1 / pixels_per_metre;
  return image;
}

EdgeBand bandAbout(const ImageEdge& edge, double inside, double outside, int longest) {
  const Eigen::Vector2d along = edge.b - edge.a;
  const Eigen::Vector2d from = edge.a + kMargin * along, to = edge.b - kMargin * along;
  const double in_depth = std::min(inside, kMaxDepth * edge.depth);
  EdgeBand band;
  band.quad = {from - in_depth * edge.outward, to - in_depth * edge.outward, to + outside * edge.outward,
               from + outside * edge.outward};
  band.upright = std::abs(along.y()) > std::abs(along.x());
  band.stride = static_cast<int>(std::clamp(along.norm() / kEnoughPixels, 1.0, std::max(1.0, static_cast<double>(longest))));
  return band;
}

}  // namespace cabinet_articulation::core
