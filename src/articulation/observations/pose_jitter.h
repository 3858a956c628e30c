// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <functional>

namespace cabinet_articulation::core {

struct PoseJitter {
  double position = 0, orientation = 0;  ///< [m], [rad] standard deviation in each of three directions
};

/// The noise of successive poses, by what leads back where it came from: a front that is moved hardly turns round within a few
/// poses (ours). Noise that a tracker has smoothed shows over more poses than one. Zero for a few poses.
PoseJitter jitterOf(std::size_t count, const std::function<Eigen::Isometry3d(std::size_t)>& pose_at);

}  // namespace cabinet_articulation::core
