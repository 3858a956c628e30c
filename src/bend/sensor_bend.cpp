// SPDX-License-Identifier: BSD-3-Clause
#include "bend/sensor_bend.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "bend/bend_estimate.h"

namespace cabinet_articulation::core {
namespace {

constexpr std::size_t kMostViews = 200;  ///< ours: 48 suffice, and an estimate from 200 takes 1 ms
constexpr int kSamples = 16;             ///< [1] in each direction (ours): terms have a degree of 4
constexpr double kMuchLarger = 1.25;     ///< ratio of pixels (ours) from which on a sight is measured again

/// Files have twelve digits.
bool same(double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(a); }

bool sameCamera(const StereoCamera& a, const StereoCamera& b) {
  return a.width == b.width && a.height == b.height && same(a.fx, b.fx) && same(a.fy, b.fy) && same(a.cx, b.cx) &&
         same(a.cy, b.cy) && same(a.baseline, b.baseline);
}

/// [px] Two standard deviations of the bend, where it is least certain. It is smooth: samples suffice.
double uncertainty(const BendMatrix& covariance, cv::Size image) {
  const BendBasis basis(image);
  double most = 0;
  for (int row = 0; row <= kSamples; ++row)
    for (int col = 0; col <= kSamples; ++col) {
      const BendVector terms = basis.at(col * (image.width - 1) / kSamples, row * (image.height - 1) / kSamples);
      most = std::max(most, terms.dot(covariance * terms));
    }
  return 2 * std::sqrt(most);
}

}  // namespace

void SensorBend::startFrom(const KnownBend& earlier) {
  *this = SensorBend();
  camera_ = earlier.camera;
  bend_ = earlier.bend;
  remaining_ = earlier.remaining;
  earlier_views_ = std::min(earlier.views, kMostViews);
  correction_.prepare({camera_.width, camera_.height}, bend_);
}

DepthFrame SensorBend::correct(const DepthFrame& frame) {
  if (!frame.left.empty()) return frame;
  follow(frame.camera);
  return correction_.process(frame, bend_);
}

void SensorBend::learn(const DepthFrame& frame, const std::vector<PlaneRegion>& regions) {
  if (!frame.left.empty()) return;
  follow(frame.camera);
  bool is_new = false;
  for (const PlaneRegion& region : regions)
    if (showsBend(region)) is_new = add(frame, region) || is_new;
  if (!is_new || views_.size() < earlier_views_) return;
  earlier_views_ = 0;
  const BendEstimate estimate = estimateBend(views_);
  bend_ = estimate.bend;
  if (!isKnown()) return;
  correction_.prepare(frame.disparity.size(), bend_);
  remaining_ = std::min(uncertainty(estimate.covariance, frame.disparity.size()), kMostBend);
}

void SensorBend::follow(const StereoCamera& camera) {
  if (sameCamera(camera, camera_)) return;
  camera_ = camera;
  views_.clear();
  oldest_ = 0;
  earlier_views_ = 0;
  bend_.setZero();
}

/// A sight that was seen before counts if much more of it is seen now, and then in place of what was seen before.
bool SensorBend::add(const DepthFrame& frame, const PlaneRegion& region) {
  const auto same = [&region](const BendView& view) { return sameSight(view.plane, region.plane); };
  if (views_.empty()) views_.reserve(kMostViews);
  const auto before = std::find_if(views_.begin(), views_.end(), same);
  const bool is_known = before != views_.end();
  if (is_known && (region.inliers < kMuchLarger * before->pixels || std::any_of(before + 1, views_.end(), same))) return false;
  const auto view = survey_.process(frame.disparity, region);
  if (!view) return false;
  if (is_known) {
    *before = *view;
  } else if (views_.size() < kMostViews) {
    views_.push_back(*view);
  } else {
    views_[oldest_] = *view;
    oldest_ = (oldest_ + 1) % kMostViews;
  }
  return true;
}

std::string SensorBend::inWords() const {
  if (camera_.width == 0) return "";
  const std::string from = std::to_string(views()) + " views of large surfaces";
  if (!isKnown()) return "no bend of the depth is known from " + from;
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f px", largest());
  return "the depth is corrected by up to " + std::string(text) + ", known from " + from;
}

}  // namespace cabinet_articulation::core
