// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/search/region_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "geometry/degrees.h"
#include "rectangles/chart/image_edge.h"
#include "rectangles/search/edge_support.h"
#include "rectangles/search/region_order.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kObservedEdge = 0.5;  ///< edge support from which a side counts as seen
constexpr double kFarthest = 1e6;      ///< [m] ours: beyond, a pixel sees the plane at its horizon
constexpr double kRandomSide = 0.2;    ///< [m] of a random start (original release)

std::optional<PlaneRectangle> outlineStart(const PlaneRegion& region, const PlaneChart& chart) {
  cv::AutoBuffer<cv::Point2f> outline(region.hull.size());
  int n = 0;
  for (const cv::Point2f& pixel : region.hull)
    if (const auto point = chart.fromPixel({pixel.x, pixel.y}); point && point->norm() < kFarthest)
      outline[n++] = cv::Point2f(static_cast<float>(point->x()), static_cast<float>(point->y()));
  if (n < 3) return std::nullopt;
  const cv::RotatedRect box = cv::minAreaRect(cv::Mat(n, 1, CV_32FC2, outline.data()));
  PlaneRectangle start;
  start.center = {box.center.x, box.center.y};
  start.angle = box.angle * kDegree;
  start.width = box.size.width;
  start.height = box.size.height;
  return start;
}

/// Paper III-B.2: at a random point of the plane, towards another one.
std::vector<PlaneRectangle> randomStarts(const PlaneRegion& region, const PlaneChart& chart, const RectanglesConfig& config) {
  std::vector<PlaneRectangle> starts;
  if (config.random_starts == 0) return starts;
  const cv::Rect box = cv::boundingRect(region.hull) & cv::Rect({0, 0}, region.mask.size());
  std::vector<cv::Point> in_plane;
  if (!box.empty()) cv::findNonZero(region.mask(box) == kInPlane, in_plane);
  if (in_plane.empty()) return starts;
  std::mt19937 random(config.seed);
  const auto draw = [&] {
    const cv::Point pixel = in_plane[random() % in_plane.size()] + box.tl();
    return chart.fromPixel({pixel.x, pixel.y});
  };
  for (int i = 0; i < config.random_starts; ++i) {
    const auto center = draw();
    const auto towards = draw();
    if (!center || !towards) continue;
    const Eigen::Vector2d direction = *towards - *center;
    starts.push_back({*center, std::atan2(direction.y(), direction.x()), kRandomSide, kRandomSide});
  }
  return starts;
}

/// True if all edges of a free fit were seen.
bool sizeObserved(const std::array<float, 4>& support) {
  return *std::min_element(support.begin(), support.end()) >= kObservedEdge;
}

}  // namespace

std::optional<RegionFit> fitRegion(const PlaneRegion& region, const PlaneChart& chart, const RectangleObjective& objective,
                                   const std::vector<Rectangle>& expected, const RectanglesConfig& config) {
  SearchResult free{{}, -std::numeric_limits<double>::infinity()};
  const auto search = [&](const PlaneRectangle& start) {
    const SearchResult result = searchRectangle(chart, objective, start, SearchFreedom::kAll, config);
    if (result.gain > free.gain) free = result;
  };
  if (const auto start = outlineStart(region, chart)) search(*start);
  for (const PlaneRectangle& start : randomStarts(region, chart, config)) search(start);
  SearchResult guided{{}, -std::numeric_limits<double>::infinity()};
  for (const Rectangle& rectangle : expected) {
    if (!liesIn(region.plane, rectangle)) continue;
    const SearchResult result = searchRectangle(chart, objective, chart.fromSpace(rectangle), SearchFreedom::kPlacement, config);
    if (result.gain > guided.gain) guided = result;
  }
  if (std::isfinite(guided.gain) && guided.gain > config.track_gain * std::max(free.gain, 0.0) &&
      !sizeObserved(edgeSupport(chart, free.rectangle, region.mask)))
    return RegionFit{guided.rectangle, true};
  if (!std::isfinite(free.gain)) return std::nullopt;
  return RegionFit{free.rectangle, false};
}

}  // namespace cabinet_articulation::core
