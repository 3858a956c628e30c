// SPDX-License-Identifier: BSD-3-Clause
#include "planes/photometric_refinement.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <opencv2/imgproc.hpp>

namespace cabinet_articulation::core {
namespace {

constexpr double kBlur = 0.5;          ///< [px]
constexpr size_t kLeastPixels = 100;   ///< six unknowns from fewer pixels are noise
constexpr float kHuber = 2;            ///< [sigma] residuals beyond count linearly
constexpr float kReject = 4;           ///< [sigma] and beyond this not at all
constexpr double kMaxRowShift = 2;     ///< [px] a worse rectification is no business of ours
constexpr double kConverged = 2e-3;    ///< [px]
constexpr double kMaxDeviation = 0.2;  ///< [px] block matching knows it better than that

constexpr int kUnknowns = 6;
constexpr int kProducts = kUnknowns * (kUnknowns + 1) / 2;
constexpr int kSums = kProducts + kUnknowns;
constexpr int kLanes = RefinementSamples::kLanes;

using Lane = float[kLanes];

/// What a Gauss-Newton step needs of the samples, whose number is a multiple of the lanes.
struct Rows {
  const float *x, *y, *slope, *right, *gradient, *row_gradient, *residual, *seen;
  size_t size;
};

/// A vector of the compiler, which splits it where registers are shorter.
using Vector __attribute__((vector_size(sizeof(Lane)))) = float;

/// What eight samples add to the normal equations.
struct Terms {
  Vector derivative[kUnknowns], weight, residual;
};

/// One after the other: the products of the weighted derivatives, then those with the residual. N at once load and store each
/// sum once.
template <size_t N>
inline void addTerms(const Terms* terms, Vector* sums) {
  int product = 0;
  for (int k = 0; k < kUnknowns; ++k) {
    Vector weighted[N];
    for (size_t n = 0; n < N; ++n) weighted[n] = terms[n].weight * terms[n].derivative[k];
    for (int m = 0; m <= k; ++m, ++product) {
      Vector sum = sums[product];
      for (size_t n = 0; n < N; ++n) sum += weighted[n] * terms[n].derivative[m];
      sums[product] = sum;
    }
    Vector sum = sums[kProducts + k];
    for (size_t n = 0; n < N; ++n) sum += weighted[n] * terms[n].residual;
    sums[kProducts + k] = sum;
  }
}

/// Two loops: the division would otherwise stay behind a branch, which keeps the compiler from vectors.
inline void robustWeights(const float* residual, const float* seen, float sigma, Lane* weight) {
  Lane linear;
  for (int i = 0; i < kLanes; ++i) linear[i] = kHuber * sigma / std::max(std::abs(residual[i]), kHuber * sigma);
  for (int i = 0; i < kLanes; ++i) {
    const float weighted = seen[i] * linear[i];
    (*weight)[i] = std::abs(residual[i]) <= kReject * sigma ? weighted : 0;
  }
}

inline void load(const float* values, Vector* vector) { std::memcpy(vector, values, sizeof(*vector)); }

inline void describe(const Rows& rows, size_t start, float gain, float sigma, Terms* terms) {
  Vector x, y, slope, right, gradient, row_gradient;
  load(rows.x + start, &x);
  load(rows.y + start, &y);
  load(rows.slope + start, &slope);
  load(rows.right + start, &right);
  load(rows.gradient + start, &gradient);
  load(rows.row_gradient + start, &row_gradient);
  load(rows.residual + start, &terms->residual);
  slope = (gain * gradient + slope) / 2;
  const Vector derivative[] = {slope * x, slope * y, slope, -gain * row_gradient, -right, Vector{} - 1};
  std::copy(std::begin(derivative), std::end(derivative), terms->derivative);
  Lane weight;
  robustWeights(rows.residual + start, rows.seen + start, sigma, &weight);
  load(weight, &terms->weight);
}

/// Every processor adds the same numbers in the same order: no fused operations are among the targets.
__attribute__((target_clones("avx2", "default"))) void addRows(const Rows& rows, float gain, float sigma, Lane* sums) {
  Vector vectors[kSums] = {};
  Terms terms[4];
  size_t start = 0;
  for (; start + std::size(terms) * kLanes <= rows.size; start += std::size(terms) * kLanes) {
    for (size_t n = 0; n < std::size(terms); ++n) describe(rows, start + n * kLanes, gain, sigma, &terms[n]);
    addTerms<std::size(terms)>(terms, vectors);
  }
  for (; start < rows.size; start += kLanes) {
    describe(rows, start, gain, sigma, terms);
    addTerms<1>(terms, vectors);
  }
  std::memcpy(sums, vectors, sizeof(vectors));
}

double total(const Lane& lane) {
  double sum = 0;
  for (const float part : lane) sum += part;
  return sum;
}

double largestShift(const GrownRegion& region, const RegionSet& set, const DisparityPlane& plane) {
  double shift = 0;
  for (int i = region.first_run; i < region.last_run; ++i) {
    const CellRun& run = set.runs[i];
    const double v = run.row * kCell;
    for (const int u : {run.begin * kCell, run.end * kCell})
      shift = std::max(shift, std::abs(plane.at(u, v) - region.plane.at(u, v)));
  }
  return shift;
}

}  // namespace

struct PhotometricRefinement::Step {
  Eigen::Matrix<double, kUnknowns, 1> value;  ///< a, b, c, row_shift, gain, offset
  double deviation;                           ///< [px] standard deviation of the worst of a, b and c
};

PhotometricRefinement::PhotometricRefinement(const PlanesConfig& config) : config_(config) { checkConfig(config_); }

void PhotometricRefinement::process(const DepthFrame& frame, const cv::Mat1f& limit, RegionSet* set) {
  setImages(frame);
  refine(frame, limit, set);
}

void PhotometricRefinement::setImages(const DepthFrame& frame) {
  // Smoothing correlates the noise of neighbours. Without it interpolated pixels are less noisy than others, which draws
  // the estimate towards half disparities.
  cv::GaussianBlur(frame.left, left_, {3, 3}, kBlur, kBlur, cv::BORDER_REPLICATE);
  cv::GaussianBlur(frame.right, right_, {3, 3}, kBlur, kBlur, cv::BORDER_REPLICATE);
  cx_difference_ = frame.camera.cx_difference;
}

void PhotometricRefinement::refine(const DepthFrame& frame, const cv::Mat1f& limit, RegionSet* set) {
  for (GrownRegion& region : set->regions)
    if (const auto plane = refined(frame, limit, region, *set)) region.plane = *plane;
}

std::optional<DisparityPlane> PhotometricRefinement::refined(const DepthFrame& frame, const cv::Mat1f& limit,
                                                             const GrownRegion& region, const RegionSet& set) {
  samples_.take(frame, limit, config_.refine_pixels, region, set);
  samples_.describe(left_);
  if (samples_.size() < kLeastPixels) return std::nullopt;
  const DisparityPlane& start = region.plane;
  const double scale = samples_.scale(), center_u = samples_.centerU(), center_v = samples_.centerV();
  PhotometricEstimate e{start.a * scale, start.b * scale, start.at(center_u, center_v), 0, 1, 0};
  for (int iteration = 0; iteration < config_.refine_iterations; ++iteration) {
    samples_.warp(right_, cx_difference_, e);
    const auto change = step(e.gain, samples_.noise());
    if (!change || !(change->deviation <= kMaxDeviation)) return std::nullopt;
    const auto& delta = change->value;
    e.a += delta[0];
    e.b += delta[1];
    e.c += delta[2];
    e.row_shift = std::min(std::max(e.row_shift + delta[3], -kMaxRowShift), kMaxRowShift);
    e.gain += delta[4];
    e.offset += delta[5];
    if (delta.head<3>().lpNorm<1>() < kConverged) break;
  }
  DisparityPlane plane;
  plane.a = e.a / scale;
  plane.b = e.b / scale;
  plane.c = e.c - plane.a * center_u - plane.b * center_v;
  if (!(largestShift(region, set, plane) <= config_.refine_max_shift)) return std::nullopt;
  return plane;
}

/// One Gauss-Newton step. The slope is the mean of both images', which doubles the order of convergence.
std::optional<PhotometricRefinement::Step> PhotometricRefinement::step(double gain, float sigma) const {
  Lane sums[kSums] = {};
  const RefinementSamples& s = samples_;
  addRows({s.x.data(), s.y.data(), s.slope.data(), s.right.data(), s.gradient.data(), s.row_gradient.data(), s.residual.data(),
           s.seen.data(), s.size()},
          static_cast<float>(gain), sigma, sums);
  Eigen::Matrix<double, kUnknowns, kUnknowns> normal;
  Eigen::Matrix<double, kUnknowns, 1> gradient;
  int product = 0;
  for (int k = 0; k < kUnknowns; ++k) {
    for (int m = 0; m <= k; ++m) normal(k, m) = normal(m, k) = total(sums[product++]);
    gradient[k] = total(sums[kProducts + k]);
  }
  const Eigen::LDLT<Eigen::Matrix<double, kUnknowns, kUnknowns>> ldlt(normal);
  if (ldlt.info() != Eigen::Success || !(ldlt.vectorD().minCoeff() > 0)) return std::nullopt;
  const Eigen::Matrix<double, kUnknowns, 3> plane_columns = ldlt.solve(Eigen::Matrix<double, kUnknowns, 3>::Identity());
  const double variance = plane_columns.topRows<3>().diagonal().maxCoeff();
  return Step{-ldlt.solve(gradient), sigma * std::sqrt(variance)};
}

}  // namespace cabinet_articulation::core
