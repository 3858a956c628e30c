// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/rectangles/rectangle_detector.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

#include "cabinet_articulation/rectangles/edge_refinement.h"
#include "cabinet_articulation/rectangles/edge_support.h"
#include "cabinet_articulation/rectangles/image_edge.h"
#include "cabinet_articulation/rectangles/rectangle_acceptance.h"
#include "cabinet_articulation/rectangles/rectangle_covariance.h"
#include "cabinet_articulation/rectangles/region_fit.h"

namespace cabinet_articulation::core {
namespace {

void requireSize(const cv::Mat& image, const cv::Size& expected, const std::string& name) {
  if (image.size() == expected) return;
  throw std::invalid_argument(name + " is " + std::to_string(image.cols) + "x" + std::to_string(image.rows) + ", the camera " +
                              std::to_string(expected.width) + "x" + std::to_string(expected.height));
}

std::optional<PlaneChart> chartOf(const PlaneRegion& region, const StereoCamera& camera) {
  if (region.hull.empty()) return std::nullopt;
  cv::Point2f middle(0, 0);
  for (const cv::Point2f& pixel : region.hull) middle += pixel / static_cast<float>(region.hull.size());
  return PlaneChart::at(region.plane, camera, {middle.x, middle.y});
}

/// Eqs. (4) and (5); nothing for a rectangle that does not fill its region.
std::optional<SupportedRectangle> assess(const PlaneChart& chart, const PlaneRectangle& rectangle, const PlaneRegion& region,
                                         const RectangleObjective& objective, const RectanglesConfig& config) {
  const std::optional<ImageQuad> quad = chart.project(rectangle);
  if (!quad) return std::nullopt;
  const LabelCounts counts = objective.count(*quad);
  SupportedRectangle result;
  result.support = counts.in_plane;
  result.detection.rectangle = chart.toSpace(rectangle);
  result.detection.precision = precision(counts, config);
  result.detection.recall = recall(counts, region.inliers);
  if (!fillsRegion(result.detection, counts, config)) return std::nullopt;
  return result;
}

/// True if a rectangle is where a track has been.
bool tracked(const Rectangle& rectangle, const std::vector<Rectangle>& expected) {
  return std::any_of(expected.begin(), expected.end(), [&](const Rectangle& track) { return sameSurface(track, rectangle); });
}

/// The size of a track stays where the images do not place both edges: an edge that they place carries the other along.
PlaneRectangle keepSize(const PlaneRectangle& sized, const RefinedRectangle& refined) {
  PlaneRectangle result = refined.rectangle;
  for (const int axis : {0, 1}) {
    const Edge minus = axis == 0 ? kEdgeMinusX : kEdgeMinusY;
    const Edge plus = axis == 0 ? kEdgePlusX : kEdgePlusY;
    if (refined.confirmed[minus] == refined.confirmed[plus]) continue;
    result.moveEdge(refined.confirmed[minus] ? plus : minus, sized.side(axis) - result.side(axis));
  }
  return result;
}

}  // namespace

struct RectangleDetector::Buffers {
  explicit Buffers(const RectanglesConfig& config) : objective(config) {}
  RectangleObjective objective;
};

RectangleDetector::RectangleDetector(const RectanglesConfig& config) : config_(config) {
  checkConfig(config_);
  buffers_ = std::make_unique<Buffers>(config_);
}

RectangleDetector::~RectangleDetector() = default;

std::vector<DetectedRectangle> RectangleDetector::process(const DepthFrame& frame, const std::vector<PlaneRegion>& regions,
                                                          const std::vector<Rectangle>& expected) {
  RectangleObjective& objective = buffers_->objective;
  const cv::Size size(frame.camera.width, frame.camera.height);
  if (!frame.left.empty()) requireSize(frame.left, size, "the left image");
  if (!frame.right.empty()) requireSize(frame.right, size, "the right image");
  std::vector<SupportedRectangle> accepted;
  for (size_t i = 0; i < regions.size(); ++i) {
    const PlaneRegion& region = regions[i];
    requireSize(region.mask, size, "the mask of region " + std::to_string(i));
    const std::optional<PlaneChart> chart = chartOf(region, frame.camera);
    if (!chart) continue;
    objective.setMask(region.mask);
    const std::optional<RegionFit> fit = fitRegion(region, *chart, objective, expected, config_);
    if (!fit || !assess(*chart, fit->rectangle, region, objective, config_)) continue;
    RefinedRectangle refined{fit->rectangle, {}};
    if (config_.refine_edges) refined = refineEdges(*chart, region, frame, fit->rectangle, config_);
    if (fit->guided) refined.rectangle = keepSize(fit->rectangle, refined);
    std::optional<SupportedRectangle> result = assess(*chart, refined.rectangle, region, objective, config_);
    if (!result) continue;
    result->detection.edge_support = edgeSupport(*chart, refined.rectangle, region.mask, refined.confirmed);
    if (!bounded(result->detection.edge_support, config_) && !tracked(result->detection.rectangle, expected)) continue;
    std::array<EdgeObservation, 4> edges;
    for (const Edge edge : kEdges) edges[edge] = {result->detection.edge_support[edge], refined.confirmed[edge]};
    result->detection.covariance = rectangleCovariance(*chart, refined.rectangle, edges, region, frame);
    result->detection.region = static_cast<int>(i);
    accepted.push_back(*result);
  }
  return selectBest(std::move(accepted), config_);
}

}  // namespace cabinet_articulation::core
