// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <vector>

namespace cabinet_articulation::core {

constexpr std::size_t kJitterTriples = 200;  ///< of successive poses: enough for a median (ours)

/// How far a step leads back where the step before came from: 0 where both go on.
double stepBack(const Eigen::Vector3d& step, const Eigen::Vector3d& next);

/// Standard deviation in each of three directions of the noise that makes such steps back, by their median.
double sigmaOfStepsBack(std::vector<double> steps_back);

struct PoseJitter {
  double position = 0, orientation = 0;  ///< [m], [rad] standard deviation in each of three directions
};

/// The noise of successive poses, by what leads back where it came from (ours). A front that is moved hardly turns round within a
/// few poses. Noise that a tracker has smoothed shows over more poses than one. Zero for a few poses.
PoseJitter jitterOf(std::size_t count, const std::function<Eigen::Isometry3d(std::size_t)>& pose_at);

}  // namespace cabinet_articulation::core
