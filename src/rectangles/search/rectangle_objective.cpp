// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/search/rectangle_objective.h"

#include <cmath>
#include <limits>

#include "cabinet_articulation/planes/plane_region.h"
#include "rectangles/chart/image_spans.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kWeightScale = 1000;  ///< integers keep the sums exact; a row of 20,000 pixels still fits 32 bits
constexpr int kAhead = 16;             ///< [px]

std::vector<std::int32_t> labelWeights(const RectanglesConfig& config, bool paper) {
  // A value that is no label says nothing about the plane.
  std::vector<std::int32_t> weights(256, std::lround(kWeightScale * (paper ? 1 - config.cost_unknown : config.weight_unknown)));
  weights[kInPlane] = kWeightScale;
  weights[kFree] = std::lround(kWeightScale * (paper ? 0 : config.weight_free));
  weights[kHole] = 0;
  weights[kOtherPlane] = std::lround(kWeightScale * (paper ? 0 : config.weight_other_plane));
  weights[kOccluded] = std::lround(kWeightScale * (paper ? 1 - config.cost_occluded : config.weight_occluded));
  return weights;
}

bool insideImage(const ImageQuad& quad, const cv::Size& size) {
  for (const Eigen::Vector2d& corner : quad)
    if (!(corner.x() >= 0 && corner.y() >= 0 && corner.x() <= size.width - 1 && corner.y() <= size.height - 1)) return false;
  return true;
}

}  // namespace

RectangleObjective::RectangleObjective(const RectanglesConfig& config)
    : paper_(config.objective == "paper"),
      alpha_(config.alpha),
      outside_weight_(config.weight_unknown),
      weights_(labelWeights(config, paper_)) {}

void RectangleObjective::setMask(const cv::Mat1b& mask) {
  mask_ = mask;
  sums_.resize(static_cast<size_t>(mask.rows) * (mask.cols + 1));
  ready_.assign(mask.rows, {});
}

inline const std::int32_t* RectangleObjective::rowSums(int v, int u_begin, int u_end) const {
  const Range& ready = ready_[v];
  if (u_begin < ready.begin || u_end > ready.end) extend(v, u_begin, u_end);
  return sums_.data() + static_cast<size_t>(v) * (mask_.cols + 1);
}

void RectangleObjective::extend(int v, int u_begin, int u_end) const {
  std::int32_t* sums = sums_.data() + static_cast<size_t>(v) * (mask_.cols + 1);
  const std::uint8_t* labels = mask_[v];
  Range& ready = ready_[v];
  if (ready.begin == ready.end) {
    ready.begin = ready.end = u_begin;
    sums[u_begin] = 0;
  }
  // Somewhat more than asked for, since the search comes back with a slightly larger rectangle.
  const int begin = std::max(u_begin - kAhead, 0);
  const int end = std::min(u_end + kAhead, mask_.cols);
  const std::int32_t* const weights = weights_.data();
  std::int32_t sum = sums[ready.begin];
  for (int u = ready.begin; u > begin; --u) sums[u - 1] = sum -= weights[labels[u - 1]];
  sum = sums[ready.end];
  for (int u = ready.end; u < end; ++u) sums[u + 1] = sum += weights[labels[u]];
  ready = {std::min(ready.begin, begin), std::max(ready.end, end)};
}

double RectangleObjective::gain(const ImageQuad& quad, int row_step) const {
  constexpr double kForbidden = -std::numeric_limits<double>::infinity();
  if (paper_ && !insideImage(quad, mask_.size())) return kForbidden;
  std::int64_t sum = 0;
  std::int64_t pixels = 0;
  std::int64_t rows = 0;
  forEachSpan(quad, mask_.cols, mask_.rows, row_step, [&](int v, int u_begin, int u_end) {
    ++rows;
    const std::int32_t* sums = rowSums(v, u_begin, u_end);
    sum += sums[u_end] - sums[u_begin];
    pixels += u_end - u_begin;
  });
  rows_seen_ += rows;
  if (pixels == 0) return kForbidden;
  pixels *= row_step;
  const double inside = static_cast<double>(sum * row_step) / kWeightScale;
  if (paper_) return inside / std::pow(pixels, 1 - alpha_);  // Eq. (3)
  return inside + outside_weight_ * std::max(0.0, area(quad) - static_cast<double>(pixels));
}

LabelCounts RectangleObjective::count(const ImageQuad& quad) const {
  LabelCounts counts;
  int total = 0;
  forEachSpan(quad, mask_.cols, mask_.rows, 1, [&](int v, int u_begin, int u_end) {
    const std::uint8_t* labels = mask_[v];
    int in_plane = 0, free = 0, occluded = 0, other = 0, hole = 0;
    for (int u = u_begin; u < u_end; ++u) {
      in_plane += labels[u] == kInPlane;
      free += labels[u] == kFree;
      hole += labels[u] == kHole;
      occluded += labels[u] == kOccluded;
      other += labels[u] == kOtherPlane;
    }
    counts.in_plane += in_plane;
    counts.free += free;
    counts.hole += hole;
    counts.occluded += occluded;
    counts.other_plane += other;
    total += u_end - u_begin;
  });
  counts.unknown = total - counts.total() - counts.hole;
  return counts;
}

}  // namespace cabinet_articulation::core
