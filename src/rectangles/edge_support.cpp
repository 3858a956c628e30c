// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/rectangles/edge_support.h"

#include <cmath>

#include "cabinet_articulation/planes/plane_region.h"
#include "cabinet_articulation/rectangles/image_edge.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kSamples = 32;           ///< per edge
constexpr double kInside = 4;          ///< [px] beyond the blur of block matching, which nibbles at edges
constexpr double kOutsideBegin = 3;    ///< [px]
constexpr double kOutsideEnd = 14;     ///< [px] block matching carries a front's depth up to a window's half beyond it
constexpr double kUnknownShare = 0.5;  ///< worth of a sample that ends in pixels without depth

bool contains(const cv::Mat1b& mask, const Eigen::Vector2d& pixel) {
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < mask.cols - 0.5 && pixel.y() < mask.rows - 0.5;
}

std::uint8_t label(const cv::Mat1b& mask, const Eigen::Vector2d& pixel) {
  return mask(static_cast<int>(pixel.y() + 0.5), static_cast<int>(pixel.x() + 0.5));
}

/// What the first surface beyond the edge says: 1 an edge, 0 none seen.
double lookOutside(const cv::Mat1b& mask, const Eigen::Vector2d& pixel, const Eigen::Vector2d& outward) {
  double found = 0;
  for (double distance = kOutsideBegin; distance <= kOutsideEnd; distance += 1) {
    const Eigen::Vector2d outside = pixel + distance * outward;
    if (!contains(mask, outside)) return found;
    switch (label(mask, outside)) {
      case kFree:
      case kOtherPlane:
        return 1;
      case kOccluded:
        return 0;
      case kInPlane:
        break;
      default:
        found = kUnknownShare;
    }
  }
  return found;
}

}  // namespace

std::array<float, 4> edgeSupport(const PlaneChart& chart, const PlaneRectangle& rectangle, const cv::Mat1b& mask) {
  std::array<float, 4> support{{0, 0, 0, 0}};
  const Eigen::Vector2d half(rectangle.width / 2, rectangle.height / 2);
  for (const Edge edge : kEdges) {
    const int axis = edgeAxis(edge);
    const Eigen::Vector2d outward = rectangle.outward(edge);
    const Eigen::Vector2d along = axis == 0 ? rectangle.yAxis() : rectangle.xAxis();
    double observed = 0;
    for (int i = 0; i < kSamples; ++i) {
      const double t = 2 * (i + 0.5) / kSamples - 1;
      const Eigen::Vector2d point = rectangle.center + half[axis] * outward + t * half[1 - axis] * along;
      const Eigen::Vector2d pixel = chart.toPixel(point);
      const Eigen::Vector2d direction = (chart.toPixel(point + 0.01 * outward) - pixel).normalized();
      const Eigen::Vector2d inside = pixel - kInside * direction;
      if (!contains(mask, pixel) || !contains(mask, inside) || label(mask, inside) != kInPlane) continue;
      observed += lookOutside(mask, pixel, direction);
    }
    support[edge] = static_cast<float>(observed / kSamples);
  }
  return support;
}

}  // namespace cabinet_articulation::core
