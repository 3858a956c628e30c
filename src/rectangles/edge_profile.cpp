// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/edge_profile.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/core/hal/intrin.hpp>

#include "rectangles/image_spans.h"

namespace cabinet_articulation::core {
namespace {

constexpr float kMinPixels = 6;                ///< of a strip
constexpr float kNoiseVariance = 4;            ///< [grey levels^2] keeps noise in textureless strips from correlating
constexpr int kReach = EdgeProfile::kOnPlane;  ///< [px] largest disparity offset

struct Eight {
  cv::v_float32x4 low, high;
};

Eight load(const std::uint8_t* pixels) {
  std::uint64_t eight;
  std::memcpy(&eight, pixels, sizeof(eight));
  cv::v_uint32x4 low, high;
  cv::v_expand(cv::v_expand_low(cv::v_reinterpret_as_u8(cv::v_uint64x2(eight, 0))), low, high);
  return {cv::v_cvt_f32(cv::v_reinterpret_as_s32(low)), cv::v_cvt_f32(cv::v_reinterpret_as_s32(high))};
}

void accumulate(float* sum, const cv::v_float32x4& value) { cv::v_store(sum, cv::v_load(sum) + value); }

}  // namespace

/// One image row: its pixels, and what is linear in u along it.
struct EdgeProfile::Row {
  const std::uint8_t *left, *right, *labels;
  float strip, strip_step;    ///< place across the edge, in strips
  float along, along_step;    ///< place along the edge, negative in the first half
  float right_u, right_step;  ///< [px] column of the largest disparity tried in the right image
  float last_column;          ///< [px] of right_u
  int u_step;
};

void EdgeProfile::addRow(const Row& row, int u_begin, int u_end, Moments* halves[2]) {
  for (int u = u_begin; u < u_end; u += row.u_step) {
    const float strip = row.strip + row.strip_step * static_cast<float>(u);
    const float right_u = row.right_u + row.right_step * static_cast<float>(u);
    if (!(strip >= 0 && strip < kStrips && right_u >= 0 && right_u < row.last_column) || row.labels[u] == kOccluded) continue;
    const int column = static_cast<int>(right_u);
    const float fraction = right_u - static_cast<float>(column);
    const std::uint8_t* right = row.right + column;
    const float l = row.left[u];
    Moments& m = halves[row.along + row.along_step * static_cast<float>(u) < 0 ? 0 : 1][static_cast<int>(strip)];
    m.n += 1;
    m.l += l;
    m.ll += l * l;
    const Eight here = load(right), next = load(right + 1);
    const cv::v_float32x4 f = cv::v_setall_f32(fraction), left = cv::v_setall_f32(l);
    int lane = 0;
    for (const cv::v_float32x4& r :
         {cv::v_muladd(f, next.low - here.low, here.low), cv::v_muladd(f, next.high - here.high, here.high)}) {
      accumulate(m.r + lane, r);
      accumulate(m.rr + lane, r * r);
      accumulate(m.lr + lane, left * r);
      lane += Moments::kLanes / 2;
    }
  }
}

EdgeProfile::EdgeProfile(const DepthFrame& frame, const PlaneRegion& region, const ImageEdge& edge) {
  const Eigen::Vector2d along = edge.b - edge.a;
  const Eigen::Vector2d middle = (edge.a + edge.b) / 2;
  const EdgeBand band = bandAbout(edge, kInside, kOutside, std::max(frame.left.cols, frame.left.rows));
  const DisparityPlane& plane = region.disparity_plane;
  Row row;
  row.u_step = band.upright ? 1 : band.stride;
  row.strip_step = static_cast<float>(edge.outward.x() / kStripWidth);
  row.along_step = static_cast<float>(along.x());
  row.right_step = static_cast<float>(1 - plane.a);
  row.last_column = static_cast<float>(frame.right.cols - Moments::kLanes - 1);
  Moments* halves[2] = {halves_[0].data(), halves_[1].data()};
  forEachSpan(band.quad, frame.left.cols, frame.left.rows, band.upright ? band.stride : 1, [&](int v, int u_begin, int u_end) {
    row.left = frame.left[v];
    row.right = frame.right[v];
    row.labels = region.mask[v];
    const Eigen::Vector2d place = Eigen::Vector2d(0, v) - middle;
    row.strip = static_cast<float>((edge.outward.dot(place) + kInside) / kStripWidth);
    row.along = static_cast<float>(along.dot(place));
    row.right_u = static_cast<float>(-plane.at(0, v) - frame.camera.cx_difference - kReach);
    addRow(row, u_begin, u_end, halves);
  });
}

EdgeProfile::Residuals EdgeProfile::residuals(const std::array<Moments, kStrips>& strips) {
  Residuals result;
  float most = 1;
  for (const Moments& m : strips) most = std::max(most, m.n);
  for (int k = 0; k < kStrips; ++k) {
    const Moments& m = strips[k];
    result.weight[k] = m.n < kMinPixels ? 0 : m.n / most;
    result.residual[k].fill(1);
    result.signal[k] = 0;
    if (m.n < kMinPixels) continue;
    float covariance[Moments::kLanes], correlation[Moments::kLanes];
    m.correlate(covariance, correlation);
    // A larger disparity lies further left in the right image.
    for (int i = 0; i < kOffsets; ++i) result.residual[k][i] = 1 - correlation[kOffsets - 1 - i];
    result.signal[k] = std::sqrt(std::max(covariance[kOffsets - 1 - kOnPlane], 0.F));
  }
  return result;
}

/// By vectors of OpenCV: a compiler's square root may set errno, which keeps it from vectors.
void EdgeProfile::Moments::correlate(float* covariance, float* correlation) const {
  const float mean_l = l / n;
  const float variance_l = ll / n - mean_l * mean_l + kNoiseVariance;
  const cv::v_float32x4 pixels = cv::v_setall_f32(n);
  for (int i = 0; i < kLanes; i += kLanes / 2) {
    const cv::v_float32x4 mean_r = cv::v_load(r + i) / pixels;
    const cv::v_float32x4 variance_r = cv::v_load(rr + i) / pixels - mean_r * mean_r + cv::v_setall_f32(kNoiseVariance);
    const cv::v_float32x4 both = cv::v_load(lr + i) / pixels - cv::v_setall_f32(mean_l) * mean_r;
    cv::v_store(covariance + i, both);
    cv::v_store(correlation + i, both / cv::v_sqrt(cv::v_setall_f32(variance_l) * variance_r));
  }
}

void EdgeProfile::Moments::add(const Moments& other) {
  n += other.n;
  l += other.l;
  ll += other.ll;
  for (int i = 0; i < kLanes; ++i) {
    r[i] += other.r[i];
    rr[i] += other.rr[i];
    lr[i] += other.lr[i];
  }
}

EdgeProfile::Residuals EdgeProfile::whole() const {
  std::array<Moments, kStrips> sum = halves_[0];
  for (int k = 0; k < kStrips; ++k) sum[k].add(halves_[1][k]);
  return residuals(sum);
}

EdgeProfile::Residuals EdgeProfile::half(int index) const { return residuals(halves_[index]); }

}  // namespace cabinet_articulation::core
