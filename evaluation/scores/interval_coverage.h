// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "sources/track_source.h"

namespace cabinet_articulation::core::evaluation {

/// How far an estimate is from what it estimates, in units of what its covariance allows: <= 1 is inside the 95 % interval.
struct IntervalCheck {
  double axis = 0;               ///< of the direction, two-dimensional
  std::optional<double> radius;  ///< rotational only
};

/// Where an axis is, and how well that is known (zero covariance: exactly).
struct AxisEstimate {
  JointType type = JointType::kRigid;
  Eigen::Vector3d axis, axis_point;
  double radius = 0;
  Matrix6d covariance = Matrix6d::Zero();
  Eigen::Vector3d center;  ///< of the front at q = 0

  static AxisEstimate of(const LearnedModel& model);
};

/// Two independent estimates of one axis, or an estimate and the truth. The direction's sign does not count.
IntervalCheck checkIntervals(const AxisEstimate& a, const AxisEstimate& b);

/// A front that opens once, seen with white noise and with noise that changes slowly (what real tracks have).
struct NoisyFront {
  Track track;
  AxisEstimate truth;
};

/// A door or a drawer with random size, place, range and noise, and `poses` poses or 40 to 150; the same seed gives the same
/// track.
NoisyFront simulateNoisyFront(JointType type, int seed, std::optional<int> poses = std::nullopt);

/// The two halves of a source, alternating blocks of a tenth, against each other; nothing if either half is not learned as
/// what it is.
std::optional<IntervalCheck> compareHalves(const TrackSource& source);

}  // namespace cabinet_articulation::core::evaluation
