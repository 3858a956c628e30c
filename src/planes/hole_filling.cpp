// SPDX-License-Identifier: BSD-3-Clause
#include "planes/hole_filling.h"

#include <cmath>

#include "cabinet_articulation/stereo/depth_frame.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kWidest = 3;       ///< [px]
constexpr float kAgreement = 1;  ///< [px] a plane seen at 80 degrees changes by this across a hole

/// Distance [px] along `stride` to the next measured pixel, or 0 if it is beyond `reach`.
int toNextMeasured(const float* pixel, int stride, int reach) {
  for (int distance = 1; distance <= reach; ++distance)
    if (isValidDisparity(pixel[distance * stride])) return distance;
  return 0;
}

/// Linear between the hole's ends along `stride`; 0 if they are too far apart.
float interpolate(const float* pixel, int stride) {
  const int before = toNextMeasured(pixel, -stride, kWidest);
  const int after = before ? toNextMeasured(pixel, stride, kWidest + 1 - before) : 0;
  if (!after) return 0;
  const float first = pixel[-before * stride], last = pixel[after * stride];
  if (std::abs(first - last) > kAgreement) return 0;
  return (first * static_cast<float>(after) + last * static_cast<float>(before)) / static_cast<float>(before + after);
}

}  // namespace

void fillHoles(const cv::Mat1f& disparity, cv::Mat1f* filled) {
  disparity.copyTo(*filled);
  const int row_stride = static_cast<int>(disparity.step1());
  for (int v = kWidest; v < disparity.rows - kWidest; ++v) {
    const float* in = disparity[v];
    float* out = (*filled)[v];
    for (int u = kWidest; u < disparity.cols - kWidest; ++u) {
      if (isValidDisparity(in[u])) continue;
      out[u] = interpolate(in + u, 1);
      if (out[u] == 0) out[u] = interpolate(in + u, row_stride);
    }
  }
}

}  // namespace cabinet_articulation::core
