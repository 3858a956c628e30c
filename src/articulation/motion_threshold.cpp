// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/motion_threshold.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cabinet_articulation::core {
namespace {

double quantile(std::vector<double> values, double share) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

double medianEdgeSupport(const Track& track) {
  std::vector<double> supports;
  for (const TrackedObservation& observation : track.observations)
    supports.push_back(std::accumulate(observation.edge_support.begin(), observation.edge_support.end(), 0.0) / 4);
  return quantile(std::move(supports), 0.5);
}

Eigen::Vector3d turn(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  const Eigen::AngleAxisd difference(from.linear().transpose() * to.linear());
  return difference.angle() * difference.axis();
}

}  // namespace

MotionThreshold motionThreshold(const Track& track, const PoseTrack& poses, const ArticulationConfig& config) {
  const auto least = static_cast<std::size_t>(config.observations_min);
  if (poses.size() < least || medianEdgeSupport(track) < config.edge_support_min) return kNeverMotion;
  // Second differences: steady motion does not enter them. Noise of standard deviation s in each of three directions has
  // second differences of sqrt(6) s in each, and a third of their lengths are below 1.25 times that. (Not the median: one
  // outlier spoils three of them.)
  constexpr double kShare = 1.0 / 3;
  const double to_sigma = 1 / (std::sqrt(6.0) * 1.25);
  std::vector<double> shifts, turns;
  for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
    const Eigen::Isometry3d &before = poses.poses[i - 1], &here = poses.poses[i], &after = poses.poses[i + 1];
    shifts.push_back((before.translation() - 2 * here.translation() + after.translation()).norm() * to_sigma);
    turns.push_back((turn(here, after) - turn(before, here)).norm() * to_sigma);
  }
  const double angle_min = config.motion_min * config.sigma_orientation / config.sigma_position;
  return {std::max(config.motion_min, config.motion_to_jitter * quantile(std::move(shifts), kShare)),
          std::max(angle_min, config.motion_to_jitter * quantile(std::move(turns), kShare))};
}

}  // namespace cabinet_articulation::core
