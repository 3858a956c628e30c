// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/planes/photometric_refinement.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace cabinet_articulation::core {
namespace {

constexpr int kLanes = 8;            ///< partial sums, fixed so that every processor adds in the same order
constexpr int kLeastPixels = 100;    ///< five unknowns from fewer pixels are noise
constexpr float kHuber = 2;          ///< [sigma] residuals beyond count linearly
constexpr float kReject = 4;         ///< [sigma] and beyond this not at all
constexpr float kSigmaFloor = 0.5F;  ///< [grey levels] quantisation
constexpr double kConverged = 2e-3;  ///< [px]
constexpr int kSigmaPixels = 512;
constexpr int kUnknowns = 5;
constexpr int kProducts = kUnknowns * (kUnknowns + 1) / 2;

}  // namespace

void PhotometricRefinement::Samples::clear() { resize(0); }

void PhotometricRefinement::Samples::resize(size_t n) {
  for (std::vector<float>* values : {&u, &x, &y, &left, &slope, &right, &gradient, &residual, &weight}) values->resize(n);
  row.resize(n);
}

PhotometricRefinement::PhotometricRefinement(const PlanesConfig& config) : config_(config) { checkConfig(config_); }

void PhotometricRefinement::setFrame(const DepthFrame& frame) {
  // Smoothing correlates the noise of neighbours: without it interpolated pixels are less noisy than others, which draws
  // the estimate towards half disparities.
  const cv::Size window(3, 3);
  frame.left.convertTo(left_, CV_32F);
  frame.right.convertTo(right_, CV_32F);
  cv::GaussianBlur(left_, left_, window, 0.8, 0.8, cv::BORDER_REPLICATE);
  cv::GaussianBlur(right_, right_, window, 0.8, 0.8, cv::BORDER_REPLICATE);
  cx_difference_ = frame.camera.cx_difference;
}

std::optional<DisparityPlane> PhotometricRefinement::refine(const GrownRegion& region, const RegionSet& set) {
  takeSamples(region, set);
  if (samples_.size() < kLeastPixels) return std::nullopt;
  const DisparityPlane& start = region.plane;
  Estimate estimate{start.a * scale_, start.b * scale_, start.at(center_u_, center_v_), 1, 0};
  for (int iteration = 0; iteration < config_.refine_iterations; ++iteration) {
    warp(estimate);
    weigh();
    const auto step = solve(estimate.gain);
    if (!step) return std::nullopt;
    estimate.a += (*step)[0];
    estimate.b += (*step)[1];
    estimate.c += (*step)[2];
    estimate.gain += (*step)[3];
    estimate.offset += (*step)[4];
    if (step->head<3>().lpNorm<1>() < kConverged) break;
  }
  DisparityPlane plane;
  plane.a = estimate.a / scale_;
  plane.b = estimate.b / scale_;
  plane.c = estimate.c - plane.a * center_u_ - plane.b * center_v_;
  if (!(largestShift(region, set, plane) <= config_.refine_max_shift)) return std::nullopt;
  return plane;
}

void PhotometricRefinement::takeSamples(const GrownRegion& region, const RegionSet& set) {
  const int step = std::max(1, region.cells * kCell * kCell / config_.refine_pixels);
  samples_.clear();
  int phase = 0;
  float sum_u = 0, sum_v = 0;
  for (int i = region.first_run; i < region.last_run; ++i) {
    const CellRun& run = set.runs[i];
    for (int v = run.row * kCell; v < (run.row + 1) * kCell; ++v) {
      int u = std::max(run.begin * kCell, 1) + phase;
      const int end = std::min(run.end * kCell, left_.cols - 1);
      for (; u < end; u += step) {
        samples_.u.push_back(u);
        samples_.row.push_back(v);
        sum_u += u;
        sum_v += v;
      }
      phase = (u - end + step) % step;
    }
  }
  const size_t n = samples_.size();
  if (n == 0) return;
  center_u_ = sum_u / n;
  center_v_ = sum_v / n;
  samples_.resize((n + kLanes - 1) / kLanes * kLanes);
  scale_ = 1;
  for (size_t i = 0; i < n; ++i)
    scale_ = std::max({scale_, std::abs(samples_.u[i] - center_u_), std::abs(samples_.row[i] - center_v_)});
  for (size_t i = 0; i < samples_.size(); ++i) {
    if (i >= n) {
      samples_.u[i] = samples_.u[0];
      samples_.row[i] = samples_.row[0];
    }
    const int u = samples_.u[i], v = samples_.row[i];
    samples_.x[i] = (u - center_u_) / scale_;
    samples_.y[i] = (v - center_v_) / scale_;
    samples_.left[i] = left_(v, u);
    samples_.slope[i] = 0.5F * (left_(v, u + 1) - left_(v, u - 1));
    samples_.weight[i] = i < n;
  }
}

void PhotometricRefinement::warp(const Estimate& e) {
  const float a = e.a, b = e.b, c = e.c + cx_difference_, gain = e.gain, offset = e.offset;
  const float last = right_.cols - 2.001F;
  for (size_t i = 0; i < samples_.size(); ++i) {
    const float wanted = samples_.u[i] - (a * samples_.x[i] + b * samples_.y[i] + c);
    const float place = std::min(std::max(wanted, 1.0F), last);
    const int column = static_cast<int>(place);
    const float f = place - column;
    const float* r = right_[samples_.row[i]] + column;
    samples_.right[i] = r[0] + f * (r[1] - r[0]);
    samples_.gradient[i] = r[1] - r[0];
    samples_.residual[i] = samples_.left[i] - gain * samples_.right[i] - offset;
    samples_.weight[i] = place == wanted;
  }
}

double PhotometricRefinement::weigh() {
  const size_t n = samples_.size();
  const size_t step = std::max<size_t>(1, n / kSigmaPixels);
  sorted_.clear();
  for (size_t i = 0; i < n; i += step)
    if (samples_.weight[i] > 0) sorted_.push_back(std::abs(samples_.residual[i]));
  if (sorted_.empty()) return 0;
  std::nth_element(sorted_.begin(), sorted_.begin() + sorted_.size() / 2, sorted_.end());
  const float sigma = std::max(1.4826F * sorted_[sorted_.size() / 2], kSigmaFloor);
  for (size_t i = 0; i < n; ++i) {
    const float error = std::abs(samples_.residual[i]) / sigma;
    const float weight = error <= kHuber ? 1.0F : error <= kReject ? kHuber / error : 0.0F;
    samples_.weight[i] *= weight;
  }
  return sigma;
}

std::optional<PhotometricRefinement::Step> PhotometricRefinement::solve(double gain_in) const {
  float sums[kProducts + kUnknowns][kLanes] = {};
  const float gain = gain_in;
  for (size_t start = 0; start < samples_.size(); start += kLanes)
    for (int lane = 0; lane < kLanes; ++lane) {
      const size_t i = start + lane;
      const float slope = 0.5F * (gain * samples_.gradient[i] + samples_.slope[i]);
      const float jacobian[kUnknowns] = {slope * samples_.x[i], slope * samples_.y[i], slope, -samples_.right[i], -1.0F};
      int product = 0;
      for (int k = 0; k < kUnknowns; ++k) {
        const float weighted = samples_.weight[i] * jacobian[k];
        for (int m = 0; m <= k; ++m) sums[product++][lane] += weighted * jacobian[m];
        sums[kProducts + k][lane] += weighted * samples_.residual[i];
      }
    }
  Eigen::Matrix<double, kUnknowns, kUnknowns> normal;
  Step gradient;
  const auto total = [&sums](int k) {
    double sum = 0;
    for (const float part : sums[k]) sum += part;
    return sum;
  };
  int product = 0;
  for (int k = 0; k < kUnknowns; ++k) {
    for (int m = 0; m <= k; ++m) normal(k, m) = normal(m, k) = total(product++);
    gradient[k] = total(kProducts + k);
  }
  const Eigen::LDLT<Eigen::Matrix<double, kUnknowns, kUnknowns>> ldlt(normal);
  if (ldlt.info() != Eigen::Success || !ldlt.isPositive()) return std::nullopt;
  const Step step = -ldlt.solve(gradient);
  if (!step.allFinite()) return std::nullopt;
  return step;
}

double PhotometricRefinement::largestShift(const GrownRegion& region, const RegionSet& set, const DisparityPlane& plane) const {
  double shift = 0;
  for (int i = region.first_run; i < region.last_run; ++i) {
    const CellRun& run = set.runs[i];
    const double v = run.row * kCell;
    for (const int col : {run.begin, run.end})
      shift = std::max(shift, std::abs(plane.at(col * kCell, v) - region.plane.at(col * kCell, v)));
  }
  return shift;
}

}  // namespace cabinet_articulation::core
