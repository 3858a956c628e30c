// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "articulation/observations/pose_sequence.h"
#include "articulation/paths/arc.h"
#include "kinds/joint_kind.h"

namespace cabinet_articulation::core {

/// The noise of a track about its path, the same for all paths that are compared.
struct TrackNoise {
  double position = 0, orientation = 0;  ///< [m], [rad] scales of Student's t
  double degrees_of_freedom = 0;
  double inflation = 1;  ///< by how much fewer poses count, since errors of successive ones are alike
  Arc line, circle;      ///< the paths nearest to the track
};

/// From the better of the free line and the free circle.
TrackNoise noiseOf(const PoseSamples& samples, const ArticulationConfig& config);

/// The most probable path of a track if something is expected of its shape.
struct ShapeFit {
  Arc arc;                  ///< its middle is where the front was first seen
  double log_evidence = 0;  ///< [nats] Laplace's approximation, up to a constant that all shapes of joints share
};

/// Fits from `start`. The prior's mean has a curvature or none, and so has the path.
ShapeFit fitShape(const PoseSamples& samples, const TrackNoise& noise, const ShapePrior& prior, const Arc& start,
                  const ArticulationConfig& config);

/// Where a joint of this shape would lead a front that is first seen as in `samples`.
Arc expectedArc(const PoseSamples& samples, const JointShape& shape);

}  // namespace cabinet_articulation::core
