// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/rectangles/rectangle_detector.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "cabinet_articulation/geometry/limits.h"
#include "rectangles/acceptance/rectangle_acceptance.h"
#include "rectangles/acceptance/rectangle_covariance.h"
#include "rectangles/chart/image_edge.h"
#include "rectangles/edges/edge_refinement.h"
#include "rectangles/edges/round_surface.h"
#include "rectangles/refit/depth_refit.h"
#include "rectangles/refit/plane_refit.h"
#include "rectangles/search/edge_support.h"
#include "rectangles/search/region_fit.h"
#include "rectangles/search/region_order.h"
#include "rectangles/search/work_budget.h"

namespace cabinet_articulation::core {
namespace {

constexpr float kHidden = 0.25F;  ///< edge support up to which an edge may well go on

std::invalid_argument wrongSize(const cv::Mat& image, const cv::Size& expected, const std::string& name) {
  return std::invalid_argument(name + " is " + std::to_string(image.cols) + "x" + std::to_string(image.rows) + ", the camera " +
                               std::to_string(expected.width) + "x" + std::to_string(expected.height));
}

void requireSizes(const DepthFrame& frame, const std::vector<PlaneRegion>& regions) {
  const cv::Size size(frame.camera.width, frame.camera.height);
  if (!frame.left.empty() && frame.left.size() != size) throw wrongSize(frame.left, size, "the left image");
  if (!frame.right.empty() && frame.right.size() != size) throw wrongSize(frame.right, size, "the right image");
  for (size_t i = 0; i < regions.size(); ++i)
    if (regions[i].mask.size() != size) throw wrongSize(regions[i].mask, size, "the mask of region " + std::to_string(i));
}

/// As the conversion from messages leaves them; asserted only.
[[maybe_unused]] bool isSane(const PlaneRegion& region) {
  const double u = limits::kHullMargin.max * region.mask.cols, v = limits::kHullMargin.max * region.mask.rows;
  return std::all_of(region.hull.begin(), region.hull.end(), [&](const cv::Point2f& corner) {
    return isWithin(corner.x, {-u, region.mask.cols + u, "px"}) && isWithin(corner.y, {-v, region.mask.rows + v, "px"});
  });
}

std::optional<PlaneChart> chartOf(const PlaneRegion& region, const StereoCamera& camera) {
  if (region.hull.empty()) return std::nullopt;
  cv::Point2f middle(0, 0);
  for (const cv::Point2f& pixel : region.hull) middle += pixel / static_cast<float>(region.hull.size());
  return PlaneChart::at(region.plane, camera, {middle.x, middle.y});
}

/// Eqs. (4) and (5); nothing for a rectangle that does not fill its region. `objective` must hold the region's mask.
std::optional<SupportedRectangle> assess(const RectangleCandidate& candidate, const RectangleObjective& objective,
                                         const RectanglesConfig& config) {
  const std::optional<ImageQuad> quad = candidate.chart.project(candidate.rectangle);
  if (!quad) return std::nullopt;
  const LabelCounts counts = objective.count(*quad);
  SupportedRectangle result;
  result.support = counts.in_plane;
  result.detection.region = candidate.index;
  result.detection.rectangle = candidate.chart.toSpace(candidate.rectangle);
  result.detection.precision = precision(counts, config);
  result.detection.recall = recall(counts, candidate.region.inliers);
  result.detection.hollow = counts.hole >= kHollowShare * (counts.hole + counts.total());
  if (!fillsRegion(result.detection, counts, config)) return std::nullopt;
  return result;
}

/// Edges that the images confirm may bend a little inside too: windows of block matching blend both sides.
std::array<float, 4> observedShares(const DepthFrame& frame, const RectangleCandidate& candidate, const PlaneRectangle& rectangle,
                                    const RefinedRectangle& refined) {
  std::array<float, 4> shares = edgeSupport(candidate.chart, rectangle, candidate.region.mask, refined.confirmed, refined.hidden);
  for (const Edge edge : kEdges) {
    if (refined.confirmed[edge]) continue;
    const std::optional<ImageEdge> image = imageEdge(candidate.chart, rectangle, edge);
    if (image && bendsAway(frame, candidate.region.disparity_plane, *image)) shares[edge] = 0;
  }
  return shares;
}

/// True if a rectangle is where a track has been.
bool tracked(const Rectangle& rectangle, const std::vector<Rectangle>& expected) {
  return std::any_of(expected.begin(), expected.end(), [&](const Rectangle& track) { return sameSurface(track, rectangle); });
}

/// False for most pieces of larger surfaces, whose planes and edges then need no refinement. Tracked places are always looked at.
bool mayPass(const RectangleCandidate& candidate, const std::vector<Rectangle>& expected, const RectanglesConfig& config) {
  if (candidate.guided) return true;
  const std::array all_confirmed{true, true, true, true};
  const auto most = edgeSupport(candidate.chart, candidate.rectangle, candidate.region.mask, all_confirmed);
  return mayBeBounded(std::accumulate(most.begin(), most.end(), 0.F), config) ||
         tracked(candidate.chart.toSpace(candidate.rectangle), expected);
}

/// The size of a track stays where neither images nor depth place both edges: an edge that they place carries the other along.
/// What something in front hides is no edge, however clear its border.
PlaneRectangle keepSize(const PlaneRectangle& sized, const RefinedRectangle& refined, const std::array<float, 4>& shares) {
  PlaneRectangle result = refined.rectangle;
  const auto placed = [&](Edge edge) { return refined.placed[edge] && shares[edge] > kHidden; };
  for (const int axis : {0, 1}) {
    const Edge minus = axis == 0 ? kEdgeMinusX : kEdgeMinusY;
    const Edge plus = axis == 0 ? kEdgePlusX : kEdgePlusY;
    if (placed(minus) == placed(plus)) continue;
    result.moveEdge(placed(minus) ? plus : minus, sized.side(axis) - result.side(axis));
  }
  return result;
}

}  // namespace

struct RectangleDetector::Buffers {
  Buffers(const RectanglesConfig& config, const PlanesConfig& planes) : objective(config), plane_refit(planes) {}
  RectangleObjective objective;
  PlaneRefit plane_refit;
  std::vector<RectangleCandidate> candidates;
  std::vector<SupportedRectangle> accepted;
};

RectangleDetector::RectangleDetector(const RectanglesConfig& config, const PlanesConfig& planes) : config_(config) {
  checkConfig(config_);
  checkConfig(planes);
  buffers_ = std::make_unique<Buffers>(config_, planes);
}

RectangleDetector::~RectangleDetector() = default;

std::vector<DetectedRectangle> RectangleDetector::process(const DepthFrame& frame, const std::vector<PlaneRegion>& regions,
                                                          const std::vector<Rectangle>& tracks) {
  assert(frame.camera.isSane());
  requireSizes(frame, regions);
  assert(std::all_of(regions.begin(), regions.end(), isSane));
  const std::vector<Rectangle> expected = config_.use_tracks ? tracks : std::vector<Rectangle>();
  search(frame.camera, regions, expected);
  std::vector<RectangleCandidate>& candidates = buffers_->candidates;
  if (config_.refine_planes) buffers_->plane_refit.process(frame, &candidates);
  std::vector<SupportedRectangle>& accepted = buffers_->accepted;
  accepted.clear();
  for (RectangleCandidate& candidate : candidates)
    if (auto result = refine({frame, regions}, expected, &candidate)) accepted.push_back(*result);
  candidates.clear();  // nobody keeps the masks' memory
  return selectBest(accepted, config_);
}

void RectangleDetector::search(const StereoCamera& camera, const std::vector<PlaneRegion>& regions,
                               const std::vector<Rectangle>& expected) {
  RectangleObjective& objective = buffers_->objective;
  WorkBudget budget(config_.time_budget);
  std::vector<RectangleCandidate>& candidates = buffers_->candidates;
  candidates.clear();
  for (const int i : regionOrder(regions, camera, expected)) {
    if (budget.exhausted()) break;
    budget.addRegion();
    const std::optional<PlaneChart> chart = chartOf(regions[i], camera);
    if (!chart) continue;
    objective.setMask(regions[i].mask);
    const std::int64_t rows = objective.rowsSeen();
    const std::optional<RegionFit> fit = fitRegion(regions[i], *chart, objective, expected, config_);
    budget.addRows(objective.rowsSeen() - rows);
    if (!fit) continue;
    const PlaneRegion& region = regions[i];
    RectangleCandidate candidate{
        i, {region.plane, region.disparity_plane, region.inliers, {}, region.mask}, *chart, fit->rectangle, fit->guided};
    if (!assess(candidate, objective, config_) || !mayPass(candidate, expected, config_)) continue;
    budget.addRefinement();
    candidates.push_back(std::move(candidate));
  }
}

std::optional<SupportedRectangle> RectangleDetector::refine(const Surroundings& surroundings,
                                                            const std::vector<Rectangle>& expected,
                                                            RectangleCandidate* candidate) {
  RefinedRectangle refined;
  refined.rectangle = candidate->rectangle;
  const DepthFrame& frame = surroundings.frame;
  if (config_.refine_edges)
    refined = refineEdges(candidate->chart, candidate->region, surroundings, candidate->rectangle, config_);
  if (config_.refine_planes && !hasImages(frame) && refitAtCrease(refined.rectangle, refined.hidden, frame, candidate))
    refined = refineEdges(candidate->chart, candidate->region, surroundings, candidate->rectangle, config_);
  if (candidate->guided)
    refined.rectangle = keepSize(candidate->rectangle, refined, observedShares(frame, *candidate, refined.rectangle, refined));
  candidate->rectangle = refined.rectangle;
  buffers_->objective.setMask(candidate->region.mask);
  std::optional<SupportedRectangle> result = assess(*candidate, buffers_->objective, config_);
  if (!result) return std::nullopt;
  DetectedRectangle& detection = result->detection;
  detection.edge_support = observedShares(frame, *candidate, candidate->rectangle, refined);
  result->tracked = tracked(detection.rectangle, expected);
  const std::array<bool, 4> cut = cutEdges(candidate->chart, candidate->rectangle, candidate->region.mask.size());
  const bool is_front = bounded(detection.edge_support, cut, config_) && framed(detection, config_);
  if (!is_front && !result->tracked) return std::nullopt;
  std::array<EdgeObservation, 4> edges;
  for (const Edge edge : kEdges) edges[edge] = {detection.edge_support[edge], refined.confirmed[edge]};
  detection.covariance = rectangleCovariance(candidate->chart, candidate->rectangle, edges, candidate->region, frame);
  return result;
}

}  // namespace cabinet_articulation::core
