// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/edges/edge_profile.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/core/hal/intrin.hpp>

#include "rectangles/chart/image_spans.h"

namespace cabinet_articulation::core {
namespace {

constexpr float kMinPixels = 6;                ///< of a strip
constexpr float kNoiseVariance = 4;            ///< [grey levels^2] keeps noise in textureless strips from correlating
constexpr int kReach = EdgeProfile::kOnPlane;  ///< [px] largest disparity offset

constexpr int kPart = EdgeProfile::kStrips;  ///< [px] of a row that are widened at once: an upright edge has no more

/// A vector of the compiler, which splits it where registers are shorter.
using Vector __attribute__((vector_size(8 * sizeof(float)))) = float;

inline void load(const float* values, Vector* vector) { std::memcpy(vector, values, sizeof(*vector)); }

inline void store(const Vector& vector, float* values) { std::memcpy(values, &vector, sizeof(vector)); }

__attribute__((target_clones("avx2", "default"))) void widen(const std::uint8_t* __restrict pixels, int n,
                                                             float* __restrict values) {
  for (int i = 0; i < n; ++i) values[i] = pixels[i];
}

}  // namespace

/// One image row: its pixels, and what is linear in u along it.
struct EdgeProfile::Row {
  const std::uint8_t *left, *right, *labels;
  float strip, strip_step;    ///< place across the edge, in strips
  float along, along_step;    ///< place along the edge, negative in the first half
  float right_u, right_step;  ///< [px] column of the largest disparity tried in the right image
  float last_column;          ///< [px] of right_u
  int u_step;

  float stripAt(int u) const { return strip + strip_step * static_cast<float>(u); }
  float rightColumn(int u) const { return right_u + right_step * static_cast<float>(u); }
  int half(int u) const { return along + along_step * static_cast<float>(u) < 0 ? 0 : 1; }
  bool isInside(int u) const {
    return stripAt(u) >= 0 && stripAt(u) < kStrips && rightColumn(u) >= 0 && rightColumn(u) < last_column;
  }
};

/// The moments of one strip, in registers while pixel after pixel falls into it.
class EdgeProfile::OpenStrip {
 public:
  inline void open(Moments* strip) {
    if (strip == strip_) return;
    close();
    strip_ = strip;
    n_ = strip->n;
    l_ = strip->l;
    ll_ = strip->ll;
    load(strip->r, &r_);
    load(strip->rr, &rr_);
    load(strip->lr, &lr_);
  }

  inline void close() {
    if (!strip_) return;
    strip_->n = n_;
    strip_->l = l_;
    strip_->ll = ll_;
    store(r_, strip_->r);
    store(rr_, strip_->rr);
    store(lr_, strip_->lr);
  }

  inline void add(float l, const Vector& r) {
    n_ += 1;
    l_ += l;
    ll_ += l * l;
    r_ += r;
    rr_ += r * r;
    lr_ += l * r;
  }

 private:
  static_assert(sizeof(Vector) == sizeof(Moments::r), "a lane for each disparity");
  Moments* strip_ = nullptr;
  float n_ = 0, l_ = 0, ll_ = 0;
  Vector r_{}, rr_{}, lr_{};
};

/// Pixels of one half of the edge. `right`: the right image from `first_column` on. Every processor adds the same numbers in the
/// same order.
__attribute__((target_clones("avx2", "default"))) void EdgeProfile::addPixels(const Row& row, int u_begin, int u_end,
                                                                              const float* right, int first_column,
                                                                              Moments* strips) {
  OpenStrip sums;
  for (int u = u_begin; u < u_end; u += row.u_step) {
    if (row.labels[u] == kOccluded) continue;
    const float right_u = row.rightColumn(u);
    const int column = static_cast<int>(right_u);
    const float fraction = right_u - static_cast<float>(column);
    Vector here, next;
    load(right + (column - first_column), &here);
    load(right + (column - first_column) + 1, &next);
    sums.open(strips + static_cast<int>(row.stripAt(u)));
    sums.add(row.left[u], fraction * (next - here) + here);
  }
  sums.close();
}

/// What is linear in u is within its limits from one place to another one, and changes its sign once.
void EdgeProfile::addRow(const Row& row, int u_begin, int u_end, Moments* halves[2]) {
  int begin = u_begin, last = u_begin + (u_end - 1 - u_begin) / row.u_step * row.u_step;
  while (begin <= last && !row.isInside(begin)) begin += row.u_step;
  while (begin <= last && !row.isInside(last)) last -= row.u_step;
  const float columns_per_step = std::max(std::abs(row.right_step) * static_cast<float>(row.u_step), 1.F);
  const int part = row.u_step * std::max(static_cast<int>(kPart / columns_per_step), 1);
  float right[kPart + Moments::kLanes + 2];
  while (begin <= last) {
    const int half = row.half(begin);
    int end = std::min(begin + part, last + 1);
    const int last_of_part = begin + (end - 1 - begin) / row.u_step * row.u_step;
    if (row.half(last_of_part) != half)
      for (end = begin; row.half(end) == half;) end += row.u_step;
    const auto [least, most] = std::minmax({row.rightColumn(begin), row.rightColumn(last_of_part)});
    const int column = static_cast<int>(least);
    widen(row.right + column, static_cast<int>(most) - column + Moments::kLanes + 1, right);
    addPixels(row, begin, end, right, column, halves[half]);
    begin += (end - 1 - begin) / row.u_step * row.u_step + row.u_step;
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
