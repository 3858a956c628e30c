// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/motion_test.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cabinet_articulation::core {
namespace {

constexpr std::size_t kTriples = 200;
/// Arms and hands are seen a few times only: fewer poses than this must show more of their edges.
constexpr std::size_t kFew = 6;
constexpr double kClearer = 0.08;

/// Who was only seen here and there did not show how it came from one to the other.
constexpr double kLargestGap = 0.7;
constexpr double kQuick = 0.5;  ///< [s] within which a hand hardly turns round

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double medianEdgeSupport(const Track& track) {
  std::vector<double> supports;
  for (const TrackedObservation& observation : track.observations)
    supports.push_back(std::accumulate(observation.edge_support.begin(), observation.edge_support.end(), 0.0) / 4);
  return median(std::move(supports));
}

/// Steps that lead back where the step before came from: a front that is moved, however unevenly, makes hardly any from one
/// frame to the next; of frames far apart nothing can be said. Noise of standard deviation s in each of three directions has a
/// median of 1.475 s of what is taken here.
double jitterOf(const PoseTrack& poses, const Eigen::Vector3d& point) {
  constexpr double kToSigma = 1 / 1.475;
  std::vector<double> back;
  const std::size_t stride = std::max<std::size_t>(1, poses.size() / kTriples);
  for (std::size_t i = 1; i + 1 < poses.size(); i += stride) {
    if (poses.stamps[i + 1] - poses.stamps[i - 1] > 2 * kQuick) continue;
    const Eigen::Vector3d here = poses.poses[i] * point;
    const Eigen::Vector3d step = here - poses.poses[i - 1] * point, next = poses.poses[i + 1] * point - here;
    back.push_back(std::sqrt(std::max(0.0, -step.dot(next))));
  }
  return kToSigma * median(std::move(back));
}

double pathOf(const ArticulationModel& model, const ModelResiduals& residuals, const Eigen::Vector3d& point) {
  constexpr int kSteps = 8;
  double length = 0;
  Eigen::Vector3d last = model.predict(residuals.q_min) * point;
  for (int i = 1; i <= kSteps; ++i) {
    const Eigen::Vector3d next = model.predict(residuals.q_min + (residuals.q_max - residuals.q_min) * i / kSteps) * point;
    length += (next - last).norm();
    last = next;
  }
  return length;
}

/// Largest share of the way along which nothing was seen.
double largestGap(const ModelResiduals& residuals) {
  const double range = residuals.q_max - residuals.q_min;
  std::vector<double> places;
  for (const double q : residuals.q)
    if (q >= residuals.q_min && q <= residuals.q_max) places.push_back(q);
  std::sort(places.begin(), places.end());
  double gap = 0;
  for (std::size_t i = 1; i < places.size(); ++i) gap = std::max(gap, places[i] - places[i - 1]);
  return range > 0 ? gap / range : 1;
}

/// Root mean square distance of a point from where the model predicts it, each cut at `limit`.
double spreadOf(const ModelResiduals& residuals, const PoseTrack& poses, const Eigen::Vector3d& point, double limit) {
  double sum = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Vector3d lever = poses.poses[i].linear() * point;
    sum += std::min(limit * limit, (residuals.position[i] + residuals.orientation[i].cross(lever)).squaredNorm());
  }
  return std::sqrt(sum / static_cast<double>(poses.size()));
}

}  // namespace

MotionTest::MotionTest(const Track& track, const PoseTrack& poses, const ArticulationConfig& config)
    : config_(config),
      refused_(poses.size() < static_cast<std::size_t>(config.observations_min) ||
               medianEdgeSupport(track) < config.edge_support_min + (poses.size() < kFew ? kClearer : 0)) {
  for (const Eigen::Vector3d& point : poses.outline) jitter_.push_back(jitterOf(poses, point));
}

bool MotionTest::passes(const ArticulationModel& model, const ModelResiduals& residuals, const PoseTrack& poses) const {
  if (refused_ || largestGap(residuals) > kLargestGap) return false;
  for (std::size_t k = 0; k < poses.outline.size(); ++k) {
    const double path = pathOf(model, residuals, poses.outline[k]);
    if (path < config_.motion_min || path < config_.motion_to_jitter * jitter_[k]) continue;
    if (path >= config_.motion_to_noise * spreadOf(residuals, poses, poses.outline[k], 3 * config_.sigma_position)) return true;
  }
  return false;
}

}  // namespace cabinet_articulation::core
