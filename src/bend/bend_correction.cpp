// SPDX-License-Identifier: BSD-3-Clause
#include "bend/bend_correction.h"

namespace cabinet_articulation::core {
namespace {

__attribute__((target_clones("avx2", "default"))) void subtract(const float* disparity, const float* bend, int n, float* out) {
  for (int u = 0; u < n; ++u) out[u] = isValidDisparity(disparity[u]) ? disparity[u] - bend[u] : disparity[u];
}

}  // namespace

DepthFrame BendCorrection::process(const DepthFrame& frame, const BendVector& bend) {
  if (bend.isZero(0) || frame.disparity.empty()) return frame;
  prepare(frame.disparity.size(), bend);
  DepthFrame result = frame;
  result.disparity = disparities_.take(frame.disparity.size());
  for (int v = 0; v < image_.rows; ++v) subtract(frame.disparity[v], image_[v], image_.cols, result.disparity[v]);
  return result;
}

void BendCorrection::prepare(cv::Size size, const BendVector& bend) {
  const bool is_drawn = basis_.size() == size;
  if (is_drawn && bend == bend_) return;
  if (!is_drawn) basis_ = BendBasis(size);
  bend_ = bend;
  basis_.draw(bend, &image_);
  largest_ = image_.empty() ? 0 : cv::norm(image_, cv::NORM_INF);
}

}  // namespace cabinet_articulation::core
