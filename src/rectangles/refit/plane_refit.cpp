// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/refit/plane_refit.h"

#include <algorithm>
#include <cmath>

#include "rectangles/chart/image_spans.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kInner = 0.95;      ///< share of the rectangle's sides that is used: edges blur
constexpr double kManyPixels = 2e4;  ///< [px^2] larger rectangles have a plane that needs no second look
constexpr double kFewPixels = 6e3;   ///< [px^2] smaller ones need a third: the better plane places them better
constexpr float kTolerance = 2;      ///< [px] pixels that block matching puts farther away belong to something in front

/// The cells inside a quadrilateral, as a region with the given plane.
void appendRegion(const ImageQuad& quad, const DisparityPlane& plane, const cv::Size& image, RegionSet* set) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : quad) middle += corner / 4;
  ImageQuad cells;
  for (size_t i = 0; i < 4; ++i) cells[i] = (middle + kInner * (quad[i] - middle)) / kCell;
  GrownRegion region;
  region.plane = plane;
  region.first_run = static_cast<int>(set->runs.size());
  forEachSpan(cells, image.width / kCell, image.height / kCell, 1, [&](int row, int begin, int end) {
    set->runs.push_back({row, begin, end});
    region.cells += end - begin;
  });
  region.last_run = static_cast<int>(set->runs.size());
  set->regions.push_back(region);
}

/// Nothing for a rectangle of more pixels.
std::optional<ImageQuad> smallQuad(const RectangleCandidate& candidate, double most) {
  const std::optional<ImageQuad> quad = candidate.chart.project(candidate.rectangle);
  return quad && !(area(*quad) > most) ? quad : std::nullopt;
}

/// The rectangle of another plane with about the same corners in the image.
std::optional<PlaneRectangle> carriedOver(const ImageQuad& quad, const PlaneChart& chart) {
  std::array<Eigen::Vector2d, 4> corners;
  for (size_t i = 0; i < 4; ++i) {
    const auto corner = chart.fromPixel(quad[i]);
    if (!corner) return std::nullopt;
    corners[i] = *corner;
  }
  const Eigen::Vector2d x = (corners[1] + corners[2] - corners[0] - corners[3]) / 2;
  const Eigen::Vector2d y = (corners[2] + corners[3] - corners[0] - corners[1]) / 2;
  // Both pairs of edges have a say in the turn, the longer ones more; y turned back by 90 degrees is (y.y, -y.x).
  const Eigen::Vector2d direction = x.norm() * x + y.norm() * Eigen::Vector2d(y.y(), -y.x());
  return PlaneRectangle{(corners[0] + corners[1] + corners[2] + corners[3]) / 4, std::atan2(direction.y(), direction.x()),
                        x.norm(), y.norm()};
}

}  // namespace

PlaneRefit::PlaneRefit(const PlanesConfig& config) : refinement_(config) {}

void PlaneRefit::process(const DepthFrame& frame, std::vector<RectangleCandidate>* candidates) {
  if (!hasImages(frame)) return;
  const auto is_small = [](const RectangleCandidate& candidate) { return smallQuad(candidate, kManyPixels).has_value(); };
  if (std::none_of(candidates->begin(), candidates->end(), is_small)) return;
  refinement_.setImages(frame);
  for (const double most : {kManyPixels, kFewPixels}) refit(frame, most, candidates);
}

/// Of the candidates of at most so many pixels.
void PlaneRefit::refit(const DepthFrame& frame, double most, std::vector<RectangleCandidate>* candidates) {
  set_.regions.clear();
  set_.runs.clear();
  small_.clear();
  for (RectangleCandidate& candidate : *candidates) {
    const std::optional<ImageQuad> quad = smallQuad(candidate, most);
    if (!quad) continue;
    appendRegion(*quad, candidate.region.disparity_plane, frame.left.size(), &set_);
    small_.push_back({&candidate, *quad});
  }
  if (small_.empty()) return;
  if (tolerance_.size() != frame.left.size()) tolerance_ = cv::Mat1f(frame.left.size(), kTolerance);
  refinement_.refine(frame, tolerance_, &set_);
  for (size_t i = 0; i < small_.size(); ++i)
    moveToPlane(set_.regions[i].plane, small_[i].quad, frame.camera, small_[i].candidate);
}

bool moveToPlane(const DisparityPlane& disparity_plane, const ImageQuad& quad, const StereoCamera& camera,
                 RectangleCandidate* candidate) {
  const auto plane = toPlane(disparity_plane, camera);
  if (!plane) return false;
  const auto chart = PlaneChart::at(*plane, camera, candidate->chart.toPixel(candidate->rectangle.center));
  const auto rectangle = chart ? carriedOver(quad, *chart) : std::nullopt;
  if (!rectangle) return false;
  candidate->region.plane = *plane;
  candidate->region.disparity_plane = disparity_plane;
  candidate->chart = *chart;
  candidate->rectangle = *rectangle;
  return true;
}

}  // namespace cabinet_articulation::core
