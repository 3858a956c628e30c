// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/articulation/pose_track.h"
#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/// A point of a front's rectangle: x, y in half widths and heights from the centre.
struct ReferencePoint {
  int x = 0;
  int y = 0;

  /// Its place in the front's own frame.
  Eigen::Vector3d offset(double width, double height) const { return {x * width / 2, y * height / 2, 0}; }
};

/// The track of a reference point, from the sizes that were measured with each pose (ours; a corner far from the hinge is
/// seen better than the centre, half of whose error comes from the edge at the hinge).
PoseTrack poseTrack(const Track& track, ReferencePoint point, const ArticulationConfig& config);

/// The point whose positions fit a circle best. `preferred` (may be null) is kept unless another is
/// clearly better.
ReferencePoint bestReferencePoint(const Track& track, const ReferencePoint* preferred, const ArticulationConfig& config);

}  // namespace cabinet_articulation::core
