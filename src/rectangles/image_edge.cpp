// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/image_edge.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kProbe = 0.001;  ///< [m] for the derivative of the projection

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

}  // namespace cabinet_articulation::core
