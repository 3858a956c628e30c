// SPDX-License-Identifier: BSD-3-Clause
#include "planes/photometric_refinement.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "geometry/median.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kBlur = 0.5;          ///< [px]
constexpr size_t kLeastPixels = 100;   ///< six unknowns from fewer pixels are noise
constexpr float kHuber = 2;            ///< [sigma] residuals beyond count linearly
constexpr float kReject = 4;           ///< [sigma] and beyond this not at all
constexpr float kLeastSigma = 0.5F;    ///< [grey levels] quantisation
constexpr size_t kNoisePixels = 512;   ///< enough for a median
constexpr double kMaxRowShift = 2;     ///< [px] a worse rectification is no business of ours
constexpr double kConverged = 2e-3;    ///< [px]
constexpr double kMaxDeviation = 0.2;  ///< [px] block matching knows it better than that

constexpr int kUnknowns = 6;
constexpr int kProducts = kUnknowns * (kUnknowns + 1) / 2;
constexpr int kSums = kProducts + kUnknowns;
constexpr int kLanes = 8;  ///< partial sums, fixed so that every processor adds in the same order

using Lane = float[kLanes];

/// What a Gauss-Newton step needs of the samples, whose number is a multiple of the lanes.
struct Rows {
  const float *x, *y, *slope, *right, *gradient, *row_gradient, *residual, *seen;
  size_t size;
};

/// Adds eight samples to the normal equations: the products of the weighted derivatives, then those with the residual.
inline void addProducts(const Lane* derivative, const Lane& weight, const Lane& residual, Lane* sums) {
  int product = 0;
  for (int k = 0; k < kUnknowns; ++k) {
    Lane weighted;
    for (int i = 0; i < kLanes; ++i) weighted[i] = weight[i] * derivative[k][i];
    for (int m = 0; m <= k; ++m, ++product)
      for (int i = 0; i < kLanes; ++i) sums[product][i] += weighted[i] * derivative[m][i];
    for (int i = 0; i < kLanes; ++i) sums[kProducts + k][i] += weighted[i] * residual[i];
  }
}

inline float robustWeight(float residual, float sigma) {
  const float error = std::abs(residual);
  const float linear = kHuber * sigma / std::max(error, kHuber * sigma);
  return error <= kReject * sigma ? linear : 0;
}

/// Every processor adds the same numbers in the same order: no fused operations are among the targets.
__attribute__((target_clones("avx2", "default"))) void addRows(const Rows& rows, float gain, float sigma, Lane* sums) {
  for (size_t start = 0; start < rows.size; start += kLanes) {
    Lane derivative[kUnknowns], weight, residual;
    for (int lane = 0; lane < kLanes; ++lane) {
      const size_t i = start + lane;
      const float slope = 0.5F * (gain * rows.gradient[i] + rows.slope[i]);
      derivative[0][lane] = slope * rows.x[i];
      derivative[1][lane] = slope * rows.y[i];
      derivative[2][lane] = slope;
      derivative[3][lane] = -gain * rows.row_gradient[i];
      derivative[4][lane] = -rows.right[i];
      derivative[5][lane] = -1;
      residual[lane] = rows.residual[i];
      weight[lane] = rows.seen[i] * robustWeight(rows.residual[i], sigma);
    }
    addProducts(derivative, weight, residual, sums);
  }
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

void PhotometricRefinement::Samples::resize(size_t n) {
  row.resize(n);
  for (std::vector<float>* values : {&u, &x, &y, &left, &slope, &inside, &right, &gradient, &row_gradient, &residual, &seen})
    values->resize(n);
}

PhotometricRefinement::PhotometricRefinement(const PlanesConfig& config) : config_(config) { checkConfig(config_); }

void PhotometricRefinement::process(const DepthFrame& frame, const cv::Mat1f& limit, RegionSet* set) {
  // Smoothing correlates the noise of neighbours. Without it interpolated pixels are less noisy than others, which draws
  // the estimate towards half disparities.
  cv::GaussianBlur(frame.left, left_, {3, 3}, kBlur, kBlur, cv::BORDER_REPLICATE);
  cv::GaussianBlur(frame.right, right_, {3, 3}, kBlur, kBlur, cv::BORDER_REPLICATE);
  cx_difference_ = frame.camera.cx_difference;
  for (GrownRegion& region : set->regions)
    if (const auto refined = refine(frame, limit, region, *set)) region.plane = *refined;
}

std::optional<DisparityPlane> PhotometricRefinement::refine(const DepthFrame& frame, const cv::Mat1f& limit,
                                                            const GrownRegion& region, const RegionSet& set) {
  takeSamples(frame, limit, region, set);
  if (samples_.size() < kLeastPixels) return std::nullopt;
  const DisparityPlane& start = region.plane;
  Estimate e{start.a * scale_, start.b * scale_, start.at(center_u_, center_v_), 0, 1, 0};
  for (int iteration = 0; iteration < config_.refine_iterations; ++iteration) {
    warp(e);
    const auto change = step(e.gain, noise());
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
  plane.a = e.a / scale_;
  plane.b = e.b / scale_;
  plane.c = e.c - plane.a * center_u_ - plane.b * center_v_;
  if (!(largestShift(region, set, plane) <= config_.refine_max_shift)) return std::nullopt;
  return plane;
}

void PhotometricRefinement::takeSamples(const DepthFrame& frame, const cv::Mat1f& limit, const GrownRegion& region,
                                        const RegionSet& set) {
  const int step = 1 + region.cells * kCell * kCell / config_.refine_pixels;
  samples_.resize(0);
  int phase = 0;  // carried over from row to row, so that the pixels do not line up in columns
  for (int i = region.first_run; i < region.last_run; ++i) {
    const CellRun& run = set.runs[i];
    for (int v = run.row * kCell; v < (run.row + 1) * kCell; ++v) {
      const int end = std::min(run.end * kCell, left_.cols - 1);
      int u = std::max(run.begin * kCell, 1) + phase;
      for (; u < end; u += step) {
        if (std::abs(frame.disparity(v, u) - region.plane.at(u, v)) > limit(v, u)) continue;
        samples_.u.push_back(static_cast<float>(u));
        samples_.row.push_back(v);
      }
      phase = u - end;
    }
  }
  describeSamples(samples_.u.size());
}

void PhotometricRefinement::describeSamples(size_t n) {
  samples_.resize((n + kLanes - 1) / kLanes * kLanes);
  double sum_u = 0, sum_v = 0;
  for (size_t i = 0; i < n; ++i) {
    sum_u += samples_.u[i];
    sum_v += samples_.row[i];
  }
  center_u_ = sum_u / std::max<size_t>(n, 1);
  center_v_ = sum_v / std::max<size_t>(n, 1);
  scale_ = 1;
  for (size_t i = 0; i < n; ++i)
    scale_ = std::max({scale_, std::abs(samples_.u[i] - center_u_), std::abs(samples_.row[i] - center_v_)});
  for (size_t i = 0; i < samples_.size(); ++i) {
    samples_.inside[i] = i < n;
    if (i >= n) {
      samples_.u[i] = samples_.u[0];
      samples_.row[i] = samples_.row[0];
    }
    const int u = static_cast<int>(samples_.u[i]);
    const std::uint8_t* left = left_[samples_.row[i]] + u;
    samples_.x[i] = static_cast<float>((u - center_u_) / scale_);
    samples_.y[i] = static_cast<float>((samples_.row[i] - center_v_) / scale_);
    samples_.left[i] = left[0];
    samples_.slope[i] = 0.5F * (left[1] - left[-1]);
  }
}

/// The right image at the samples' places, bilinear, and its derivatives.
void PhotometricRefinement::warp(const Estimate& e) {
  const float a = static_cast<float>(e.a), b = static_cast<float>(e.b), c = static_cast<float>(e.c + cx_difference_);
  const float gain = static_cast<float>(e.gain), offset = static_cast<float>(e.offset);
  const int rows_down = static_cast<int>(std::floor(e.row_shift));
  const float g = static_cast<float>(e.row_shift - rows_down);
  const float last_column = static_cast<float>(right_.cols) - 1.001F;
  for (size_t i = 0; i < samples_.size(); ++i) {
    const float wanted = samples_.u[i] - (a * samples_.x[i] + b * samples_.y[i] + c);
    const float place = std::min(std::max(wanted, 0.0F), last_column);
    const int column = static_cast<int>(place);
    const int row = std::min(std::max(samples_.row[i] + rows_down, 0), right_.rows - 2);
    const float f = place - static_cast<float>(column);
    const std::uint8_t* up = right_[row] + column;
    const std::uint8_t* down = up + right_.step;
    const float slope_up = static_cast<float>(up[1] - up[0]), slope_down = static_cast<float>(down[1] - down[0]);
    const float value_up = up[0] + f * slope_up, value_down = down[0] + f * slope_down;
    samples_.right[i] = value_up + g * (value_down - value_up);
    samples_.gradient[i] = slope_up + g * (slope_down - slope_up);
    samples_.row_gradient[i] = value_down - value_up;
    samples_.residual[i] = samples_.left[i] - gain * samples_.right[i] - offset;
    samples_.seen[i] = place == wanted ? samples_.inside[i] : 0;
  }
}

/// [grey levels] robust standard deviation of the residuals.
float PhotometricRefinement::noise() {
  const size_t stride = std::max<size_t>(1, samples_.size() / kNoisePixels);
  sorted_.clear();
  for (size_t i = 0; i < samples_.size(); i += stride)
    if (samples_.seen[i] > 0) sorted_.push_back(std::abs(samples_.residual[i]));
  if (sorted_.empty()) return kLeastSigma;
  const auto middle = sorted_.begin() + sorted_.size() / 2;
  std::nth_element(sorted_.begin(), middle, sorted_.end());
  return std::max(static_cast<float>(kDeviationToSigma) * *middle, kLeastSigma);
}

/// One Gauss-Newton step. The slope is the mean of both images', which doubles the order of convergence.
std::optional<PhotometricRefinement::Step> PhotometricRefinement::step(double gain, float sigma) const {
  Lane sums[kSums] = {};
  const Samples& s = samples_;
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
