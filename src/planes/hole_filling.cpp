// SPDX-License-Identifier: BSD-3-Clause
#include "planes/hole_filling.h"

#include <algorithm>
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

/// The next pixel from `u` on that was measured.
int endOfHole(const float* row, int u, int cols) {
  while (u < cols && !isValidDisparity(row[u])) ++u;
  return u;
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
    for (int u = kWidest, end = u; u < disparity.cols - kWidest; u = end + 1) {
      end = endOfHole(in, u, disparity.cols);
      const bool is_narrow = end - u <= kWidest || u == kWidest;
      for (int hole = u; hole < std::min(end, disparity.cols - kWidest); ++hole) {
        out[hole] = is_narrow ? interpolate(in + hole, 1) : 0;
        if (out[hole] == 0) out[hole] = interpolate(in + hole, row_stride);
      }
    }
  }
}

}  // namespace cabinet_articulation::core
