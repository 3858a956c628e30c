// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/geometry/rectangle.h"
#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/// Where a tracked front was seen last and how it moved then. In the fixed frame.
struct ExpectedFront {
  double stamp = 0;  ///< [s] of the newest observation
  Rectangle rectangle;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();          ///< [m/s] of the centre
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< [rad/s] about axes of the fixed frame

  /// Where it will be at `stamp` if it keeps its velocity for at most `horizon` [s].
  Rectangle at(double stamp, double horizon) const;
};

/// The newest observation, and its motion in the last tenth of a second. The history must not be empty.
ExpectedFront newestMotion(const std::vector<TrackedObservation>& history);

/// What the tracker tells the detector after each frame: a proposal for every front it is sure of.
struct ExpectedFronts {
  double horizon = 0;  ///< [s] a motion is predicted for this long at most
  std::vector<ExpectedFront> fronts;

  std::vector<Rectangle> at(double stamp) const;
};

}  // namespace cabinet_articulation::core
