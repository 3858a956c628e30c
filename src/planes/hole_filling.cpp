// SPDX-License-Identifier: BSD-3-Clause
#include "planes/hole_filling.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/core/utility.hpp>

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

__attribute__((target_clones("avx2", "default"))) void markMeasured(const float* __restrict disparity, int n,
                                                                    std::uint8_t* __restrict measured) {
  for (int u = 0; u < n; ++u) measured[u] = isValidDisparity(disparity[u]) ? 1 : 0;
}

/// The next pixel from `u` on with this value, or `end`.
int find(const std::uint8_t* measured, int u, int end, int value) {
  const void* const found = u < end ? std::memchr(measured + u, value, end - u) : nullptr;
  return found ? static_cast<int>(static_cast<const std::uint8_t*>(found) - measured) : end;
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
  const int row_stride = static_cast<int>(disparity.step1()), last = disparity.cols - kWidest;
  cv::AutoBuffer<std::uint8_t> measured(disparity.cols);
  for (int v = kWidest; v < disparity.rows - kWidest; ++v) {
    const float* in = disparity[v];
    float* out = (*filled)[v];
    markMeasured(in, disparity.cols, measured.data());
    for (int begin = kWidest, end = 0; (begin = find(measured.data(), begin, last, 0)) < last; begin = end) {
      end = find(measured.data(), begin, disparity.cols, 1);
      const bool is_narrow = end - begin <= kWidest || begin == kWidest;
      for (int u = begin; u < std::min(end, last); ++u) {
        out[u] = is_narrow ? interpolate(in + u, 1) : 0;
        if (out[u] == 0) out[u] = interpolate(in + u, row_stride);
      }
    }
  }
}

}  // namespace cabinet_articulation::core
