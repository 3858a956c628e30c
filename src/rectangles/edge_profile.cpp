// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/rectangles/edge_profile.h"

#include <algorithm>
#include <cmath>

#include "cabinet_articulation/rectangles/image_spans.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kMargin = 0.04;     ///< share of the edge left out at either end, where the neighbouring edges begin
constexpr float kMinPixels = 6;      ///< of a strip
constexpr float kNoiseVariance = 4;  ///< [grey levels^2] keeps noise in textureless strips from correlating
constexpr int kMinLevelStrips = 4;   ///< 2 px: a level of fewer strips is noise

}  // namespace

EdgeProfile::EdgeProfile(const DepthFrame& frame, const DisparityPlane& plane, const ImageEdge& edge) : halves_{} {
  const Eigen::Vector2d along = edge.b - edge.a;
  const Eigen::Vector2d& outward = edge.outward;
  const Eigen::Vector2d from = edge.a + kMargin * along;
  const Eigen::Vector2d to = edge.b - kMargin * along;
  const ImageQuad band{from - kInside * outward, to - kInside * outward, to + kOutside * outward, from + kOutside * outward};
  const int width = frame.left.cols;
  forEachSpan(band, width, frame.left.rows, [&](int v, int u_begin, int u_end) {
    const std::uint8_t* left = frame.left[v];
    const std::uint8_t* right = frame.right[v];
    for (int u = u_begin; u < u_end; ++u) {
      const double right_u = u - plane.at(u, v) - frame.camera.cx_difference;
      if (!(right_u >= 0 && right_u < width - 1)) continue;
      const int column = static_cast<int>(right_u);
      const float fraction = static_cast<float>(right_u - column);
      const float l = left[u];
      const float r = right[column] + fraction * (right[column + 1] - right[column]);
      const Eigen::Vector2d offset = Eigen::Vector2d(u, v) - edge.a;
      const int strip = static_cast<int>((outward.dot(offset) + kInside) / kStripWidth);
      if (strip < 0 || strip >= kStrips) continue;
      Moments& m = halves_[along.dot(offset) > 0.5 * along.squaredNorm()][strip];
      m.n += 1;
      m.l += l;
      m.r += r;
      m.ll += l * l;
      m.rr += r * r;
      m.lr += l * r;
    }
  });
}

EdgeProfile::Moments EdgeProfile::sum(const Moments& a, const Moments& b) {
  return {a.n + b.n, a.l + b.l, a.r + b.r, a.ll + b.ll, a.rr + b.rr, a.lr + b.lr};
}

double EdgeProfile::correlation(const Moments& m) {
  if (m.n < kMinPixels) return 0;
  const float variance_l = m.ll / m.n - m.l * m.l / (m.n * m.n);
  const float variance_r = m.rr / m.n - m.r * m.r / (m.n * m.n);
  const float covariance = m.lr / m.n - m.l * m.r / (m.n * m.n);
  return covariance / std::sqrt((std::max(variance_l, 0.F) + kNoiseVariance) * (std::max(variance_r, 0.F) + kNoiseVariance));
}

EdgeProfile::Correlations EdgeProfile::correlations() const {
  Correlations result;
  for (int i = 0; i < kStrips; ++i) result[i] = correlation(sum(halves_[0][i], halves_[1][i]));
  return result;
}

EdgeProfile::Correlations EdgeProfile::correlationsOfHalf(int half) const {
  Correlations result;
  for (int i = 0; i < kStrips; ++i) result[i] = correlation(halves_[half][i]);
  return result;
}

EdgeStep fitStep(const EdgeProfile::Correlations& correlations) {
  constexpr int n = EdgeProfile::kStrips;
  double total = 0;
  for (const double value : correlations) total += value;
  EdgeStep best;
  double best_between = -1;
  double inner = 0;
  for (int i = 1; i < n; ++i) {
    inner += correlations[i - 1];
    if (i < kMinLevelStrips || n - i < kMinLevelStrips) continue;
    const double inside = inner / i;
    const double outside = (total - inner) / (n - i);
    // Least squares of a two-level step: maximal variance between the levels.
    const double between = static_cast<double>(i) * (n - i) * (inside - outside) * (inside - outside);
    if (inside > outside && between > best_between) {
      best_between = between;
      best = {EdgeProfile::offset(i - 1), inside, outside};
    }
  }
  return best;
}

}  // namespace cabinet_articulation::core
