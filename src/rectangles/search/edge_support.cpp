// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/search/edge_support.h"

#include <algorithm>
#include <cmath>

#include "cabinet_articulation/planes/plane_region.h"
#include "rectangles/chart/image_edge.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kSamples = 32;          ///< per edge
constexpr double kInside = 4;         ///< [px] beyond the blur of block matching, which nibbles at edges
constexpr double kDeepInside = 9;     ///< [px] beyond what a surface along the edge (a door's side) claims of the front
constexpr double kOutsideBegin = 3;   ///< [px]
constexpr double kOutsideEnd = 14;    ///< [px] block matching carries a front's depth up to a window's half beyond it
constexpr double kProbe = 0.01;       ///< [m] for the direction outward in the image
constexpr double kUndecided = 0.5;    ///< worth of a sample beyond which there is no depth
constexpr double kMostHidden = 0.01;  ///< [m] of an edge behind its neighbour, beyond which its place is worth nothing
constexpr double kDisputed = 0.25;    ///< worth of a sample that ends in another region of nearly the same plane

bool contains(const cv::Size& image, const Eigen::Vector2d& pixel) {
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < image.width - 0.5 && pixel.y() < image.height - 0.5;
}

std::uint8_t label(const cv::Mat1b& mask, const Eigen::Vector2d& pixel) {
  return mask(static_cast<int>(pixel.y() + 0.5), static_cast<int>(pixel.x() + 0.5));
}

bool seenInside(const cv::Mat1b& mask, const Eigen::Vector2d& pixel, const Eigen::Vector2d& outward) {
  for (const double distance : {kInside, kDeepInside}) {
    const Eigen::Vector2d inside = pixel - distance * outward;
    if (!contains(mask.size(), inside)) return false;
    if (label(mask, inside) != kOtherPlane) return label(mask, inside) == kInPlane;
  }
  return false;
}

/// 1 if the first surface beyond the edge is farther away, 0 if it hides the edge or there is none.
double lookOutside(const cv::Mat1b& mask, const Eigen::Vector2d& pixel, const Eigen::Vector2d& outward, bool confirmed) {
  double found = confirmed ? 1 : 0;
  for (double distance = kOutsideBegin; distance <= kOutsideEnd; distance += 1) {
    const Eigen::Vector2d outside = pixel + distance * outward;
    if (!contains(mask.size(), outside)) return 0;
    switch (label(mask, outside)) {
      case kFree:
        return 1;
      case kOccluded:
        return 0;
      case kInPlane:
        break;
      case kOtherPlane:
        found = kDisputed;
        break;
      default:
        found = kUndecided;
    }
  }
  return found;
}

/// Places along an edge, and which way is outward there, both in the image.
template <class Use>
void forEachPlace(const PlaneChart& chart, const PlaneRectangle& rectangle, Edge edge, Use&& use) {
  const Eigen::Vector2d half(rectangle.width / 2, rectangle.height / 2);
  const int axis = edgeAxis(edge);
  const Eigen::Vector2d outward = rectangle.outward(edge);
  const Eigen::Vector2d along = axis == 0 ? rectangle.yAxis() : rectangle.xAxis();
  for (int i = 0; i < kSamples; ++i) {
    const double t = 2 * (i + 0.5) / kSamples - 1;
    const Eigen::Vector2d point = rectangle.center + half[axis] * outward + t * half[1 - axis] * along;
    const Eigen::Vector2d pixel = chart.toPixel(point);
    use(pixel, Eigen::Vector2d((chart.toPixel(point + kProbe * outward) - pixel).normalized()));
  }
}

}  // namespace

std::array<float, 4> edgeSupport(const PlaneChart& chart, const PlaneRectangle& rectangle, const cv::Mat1b& mask,
                                 const std::array<bool, 4>& confirmed, const HiddenBehind& hidden) {
  std::array<float, 4> support{{0, 0, 0, 0}};
  for (const Edge edge : kEdges) {
    double observed = 0;
    forEachPlace(chart, rectangle, edge, [&](const Eigen::Vector2d& pixel, const Eigen::Vector2d& direction) {
      if (!contains(mask.size(), pixel) || !seenInside(mask, pixel, direction)) return;
      observed +=
          hidden[edge] ? std::max(1 - *hidden[edge] / kMostHidden, 0.0) : lookOutside(mask, pixel, direction, confirmed[edge]);
    });
    support[edge] = static_cast<float>(observed / kSamples);
  }
  return support;
}

std::array<bool, 4> cutEdges(const PlaneChart& chart, const PlaneRectangle& rectangle, const cv::Size& image) {
  std::array<bool, 4> cut{};
  for (const Edge edge : kEdges) {
    int outside = 0;
    forEachPlace(chart, rectangle, edge, [&](const Eigen::Vector2d& pixel, const Eigen::Vector2d& direction) {
      outside += !contains(image, pixel) || !contains(image, pixel + kOutsideEnd * direction);
    });
    cut[edge] = 2 * outside > kSamples;
  }
  return cut;
}

}  // namespace cabinet_articulation::core
