// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/articulation/pose_track.h"
#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/// Less than this is not called motion.
struct MotionThreshold {
  double path = 0;   ///< [m]
  double angle = 0;  ///< [rad] turning on the spot
};

constexpr MotionThreshold kNeverMotion{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

/**
 * How far a front must move before it may be called moving (ours). Pieces of furniture that are hardly visible jitter by
 * centimetres and tens of degrees while they stand still, in two ways that a real motion does not share: from one frame to
 * the next (a multiple of the typical second difference must be exceeded), and with most of their edges unseen (infinite
 * while the median observation has less than edge_support_min of its edges, or there are fewer than observations_min).
 *
 * `poses` are those of `track`'s front, in the order of their stamps.
 */
MotionThreshold motionThreshold(const Track& track, const PoseTrack& poses, const ArticulationConfig& config);

}  // namespace cabinet_articulation::core
