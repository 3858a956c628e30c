// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/sad_matcher.h"

#include <algorithm>
#include <cstdlib>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/utility.hpp>

namespace cabinet_articulation::core {
namespace {

int roundedUp(int value, int step) { return (value + step - 1) / step * step; }

/// The horizontal Sobel gradient, cut to +-cap, plus cap. Rows are mirrored at the image's border.
void filterRow(const cv::Mat1b& image, int v, int cap, bool continue_left, std::uint8_t* out) {
  const int last_row = image.rows - 1, last = image.cols - 1;
  const std::uint8_t* above = image[v > 0 ? v - 1 : std::min(1, last_row)];
  const std::uint8_t* row = image[v];
  const std::uint8_t* below = image[v < last_row ? v + 1 : std::max(last_row - 1, 0)];
  // Gradients fit into 16 bits: twice as many in a vector as of 32.
  const auto lowest = static_cast<std::int16_t>(-cap), highest = static_cast<std::int16_t>(cap);
  const auto gradient = [=](int left, int right) {
    const auto sum =
        static_cast<std::int16_t>(above[right] - above[left] + 2 * (row[right] - row[left]) + below[right] - below[left]);
    return static_cast<std::uint8_t>(std::min(std::max(sum, lowest), highest) + highest);
  };
  out[0] = continue_left ? gradient(0, 1) : static_cast<std::uint8_t>(cap);
  for (int u = 1; u < last; ++u) out[u] = gradient(u - 1, u + 1);
  out[last] = static_cast<std::uint8_t>(cap);
}

}  // namespace

bool SadMatcher::supports(const StereoConfig& config) {
  const int pixels = config.correlation_window_size * config.correlation_window_size;
  return pixels * 2 * config.prefilter_cap <= INT16_MAX;
}

SadMatcher::SadMatcher(const StereoConfig& config)
    : config_(config),
      radius_(config.correlation_window_size / 2),
      window_(2 * radius_ + 1),
      largest_disparity_(config.min_disparity + config.disparity_range - 1),
      unmatched_(static_cast<std::int16_t>((config.min_disparity - 1) * cv::StereoMatcher::DISP_SCALE)),
      match_row_(cv::checkHardwareSupport(CV_CPU_AVX2) && sadRowForAvx2() ? sadRowForAvx2() : matchSadRow) {}

void SadMatcher::resize(cv::Size size) {
  if (sixteenths_.size() == size) return;
  // StereoBM leaves out the columns whose search would leave the right image.
  const int continued = config_.recover_left_band ? config_.disparity_range + std::max(config_.min_disparity, 0) : 0;
  const int most_left = config_.recover_left_band ? 0 : radius_;
  columns_.start = std::max(largest_disparity_ + radius_ - continued, most_left);
  columns_.end = std::max(size.width - radius_ + std::min(config_.min_disparity, 0), columns_.start);
  margin_ = roundedUp(std::max(largest_disparity_, 0) + radius_, kSadStride);
  const int right_margin = radius_ + kSadBatch + kSadStride + std::max(-config_.min_disparity, 0);
  for (cv::Mat1b* image : {&left_, &right_}) {
    image->create(size.height + 1, roundedUp(margin_ + size.width + right_margin, kSadStride));
    *image = static_cast<std::uint8_t>(config_.prefilter_cap);
  }
  sixteenths_.create(size);
  sixteenths_ = unmatched_;
}

SadRow SadMatcher::prepare(Stripe* stripe) const {
  const int columns = roundedUp(columns_.size(), kSadBatch) + 2 * radius_;
  SadRow row{};
  row.first = columns_.start;
  row.end = columns_.end;
  row.radius = radius_;
  row.disparities = config_.disparity_range;
  row.largest_disparity = largest_disparity_;
  row.stride = roundedUp(config_.disparity_range, kSadStride);
  // Of a window that begins or ends a buffer, a neighbour beyond is read, but not used.
  stripe->sums.create(1 + kSadBatch + window_ + columns, row.stride);
  stripe->sums = 0;
  stripe->column_texture.create(1, columns + 1);
  stripe->column_texture = 0;
  stripe->texture.create(1, columns_.end + kSadBatch);
  stripe->texture = 0;
  row.window_sums = stripe->sums[1];
  row.column_sums = stripe->sums[1 + kSadBatch];
  row.texture = stripe->texture[0];
  row.texture_threshold = config_.texture_threshold;
  row.uniqueness_ratio = static_cast<int>(config_.uniqueness_ratio);
  row.unmatched = unmatched_;
  return row;
}

void SadMatcher::updateTexture(const SadRow& row, Stripe* stripe) const {
  const int first = row.first - row.radius, cap = config_.prefilter_cap;
  const std::uint8_t *enters = row.left_enters + first, *leaves = row.left_leaves + first;
  int* columns = stripe->column_texture[0];
  for (int i = 0; i < stripe->column_texture.cols; ++i) columns[i] += std::abs(enters[i] - cap) - std::abs(leaves[i] - cap);
  int* texture = stripe->texture[0] + row.first;
  int sum = 0;
  for (int i = 0; i < window_; ++i) sum += columns[i];
  for (int i = 0; i < columns_.size(); ++i) {
    texture[i] = sum;
    sum += columns[i + window_] - columns[i];
  }
}

void SadMatcher::match(const cv::Range& rows, Stripe* stripe) {
  SadRow row = prepare(stripe);
  const int start = rows.start - radius_, without_gradient = left_.rows - 1;
  for (int v = start; v < rows.end + radius_; ++v) {
    const int leaves = v - window_ >= start ? v - window_ : without_gradient;
    row.left_enters = left_[v] + margin_;
    row.right_enters = right_[v] + margin_;
    row.left_leaves = left_[leaves] + margin_;
    row.right_leaves = right_[leaves] + margin_;
    updateTexture(row, stripe);
    row.sixteenths = v - radius_ >= rows.start ? sixteenths_[v - radius_] : nullptr;
    match_row_(row);
  }
}

const cv::Mat1s& SadMatcher::compute(const cv::Mat1b& left, const cv::Mat1b& right) {
  resize(left.size());
  cv::parallel_for_({0, left.rows}, [&](const cv::Range& range) {
    for (int v = range.start; v < range.end; ++v) {
      filterRow(left, v, config_.prefilter_cap, config_.recover_left_band, left_[v] + margin_);
      filterRow(right, v, config_.prefilter_cap, config_.recover_left_band, right_[v] + margin_);
    }
  });
  const int first = radius_, rows = left.rows - 2 * radius_;
  if (rows <= 0 || columns_.empty()) return sixteenths_;
  // The first rows of a stripe are summed up once more: shorter stripes than a window would do little else.
  const int stripes = std::clamp(cv::getNumThreads(), 1, std::max(rows / window_, 1));
  stripes_.resize(stripes);
  cv::parallel_for_({0, stripes}, [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i)
      match({first + rows * i / stripes, first + rows * (i + 1) / stripes}, &stripes_[i]);
  });
  if (config_.speckle_size > 0) speckle_filter_.process(config_.speckle_size, config_.speckle_range, unmatched_, &sixteenths_);
  return sixteenths_;
}

}  // namespace cabinet_articulation::core
