// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/rectangles/edge_profile.h"

#include <algorithm>
#include <cmath>

#include "cabinet_articulation/rectangles/image_spans.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kMargin = 0.04;             ///< share of the edge left out at either end, where the neighbouring edges begin
constexpr double kMaxDepth = 0.6;            ///< share of the rectangle's depth that may be looked at from one edge
constexpr float kMinPixels = 6;              ///< of a strip
constexpr float kNoiseVariance = 4;          ///< [grey levels^2] keeps noise in textureless strips from correlating
constexpr float kSmallestResidual = 0.005F;  ///< share of the variance that interpolation alone leaves unexplained
constexpr int kReach = EdgeProfile::kOnPlane / 2;  ///< [px] largest disparity offset

}  // namespace

EdgeProfile::EdgeProfile(const DepthFrame& frame, const PlaneRegion& region, const ImageEdge& edge) {
  const DisparityPlane& plane = region.disparity_plane;
  const Eigen::Vector2d along = edge.b - edge.a;
  const Eigen::Vector2d from = edge.a + kMargin * along;
  const Eigen::Vector2d to = edge.b - kMargin * along;
  const double inside = std::min(kInside, kMaxDepth * edge.depth);
  const ImageQuad band{from - inside * edge.outward, to - inside * edge.outward, to + kOutside * edge.outward,
                       from + kOutside * edge.outward};
  const int width = frame.left.cols;
  const double half_length = 0.5 * along.squaredNorm();
  forEachSpan(band, width, frame.left.rows, [&](int v, int u_begin, int u_end) {
    const std::uint8_t* left = frame.left[v];
    const std::uint8_t* right = frame.right[v];
    const std::uint8_t* labels = region.mask[v];
    for (int u = u_begin; u < u_end; ++u) {
      if (labels[u] == kOccluded) continue;
      const Eigen::Vector2d offset = Eigen::Vector2d(u, v) - edge.a;
      const int strip = static_cast<int>((edge.outward.dot(offset) + kInside) / kStripWidth);
      if (strip < 0 || strip >= kStrips) continue;
      // A larger disparity lies further left in the right image: lane i holds the disparity i steps below the largest.
      const double right_u = u - plane.at(u, v) - frame.camera.cx_difference - kReach;
      if (!(right_u >= 0 && right_u < width - 2 * kReach - 2)) continue;
      const int column = static_cast<int>(right_u);
      const auto fraction = static_cast<float>(right_u - column);
      const int shift = fraction < 0.5F ? 0 : 1;
      const float half_fraction = fraction < 0.5F ? fraction + 0.5F : fraction - 0.5F;
      float r[kLanes] = {};
      for (int i = 0; i <= 2 * kReach; ++i) {
        const std::uint8_t* p = right + column + i;
        r[2 * i] = p[0] + fraction * (p[1] - p[0]);
        const std::uint8_t* q = p + shift;
        if (i < 2 * kReach) r[2 * i + 1] = q[0] + half_fraction * (q[1] - q[0]);
      }
      const float l = left[u];
      Moments& m = halves_[along.dot(offset) > half_length ? 1 : 0][strip];
      m.n += 1;
      m.l += l;
      m.ll += l * l;
      for (int i = 0; i < kLanes; ++i) {
        m.r[i] += r[i];
        m.rr[i] += r[i] * r[i];
        m.lr[i] += l * r[i];
      }
    }
  });
}

EdgeProfile::Costs EdgeProfile::costs(const std::array<Moments, kStrips>& strips) {
  Costs result;
  float most = 1;
  for (const Moments& m : strips) most = std::max(most, m.n);
  for (int k = 0; k < kStrips; ++k) {
    const Moments& m = strips[k];
    result.weight[k] = m.n < kMinPixels ? 0 : m.n / most;
    result.cost[k].fill(0);
    if (m.n < kMinPixels) continue;
    const float mean_l = m.l / m.n;
    const float variance_l = m.ll / m.n - mean_l * mean_l + kNoiseVariance;
    for (int i = 0; i < kOffsets; ++i) {
      const int lane = kOffsets - 1 - i;
      const float mean_r = m.r[lane] / m.n;
      const float variance_r = m.rr[lane] / m.n - mean_r * mean_r + kNoiseVariance;
      const float covariance = m.lr[lane] / m.n - mean_l * mean_r;
      result.cost[k][i] = std::log(std::max(1 - covariance / std::sqrt(variance_l * variance_r), kSmallestResidual));
    }
  }
  return result;
}

EdgeProfile::Costs EdgeProfile::whole() const {
  std::array<Moments, kStrips> sum = halves_[0];
  for (int k = 0; k < kStrips; ++k) {
    const Moments& m = halves_[1][k];
    sum[k].n += m.n;
    sum[k].l += m.l;
    sum[k].ll += m.ll;
    for (int i = 0; i < kLanes; ++i) {
      sum[k].r[i] += m.r[i];
      sum[k].rr[i] += m.rr[i];
      sum[k].lr[i] += m.lr[i];
    }
  }
  return costs(sum);
}

EdgeProfile::Costs EdgeProfile::half(int index) const { return costs(halves_[index]); }

}  // namespace cabinet_articulation::core
