// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "articulation/fitting/arc_fit.h"

namespace cabinet_articulation::core {

/// Where a fit may start: the line or circle that most positions agree on. It is one of the closed-form solutions from all poses
/// and from random pairs or triples.
Arc consensusArc(const PoseSamples& samples, PathShape shape, const ArticulationConfig& config);

/// The circle that turns of the front speak for, about the point of it that keeps its place best. Few poses that hardly
/// leave a line say more by their turns.
Arc turningCircle(const PoseSamples& samples, const ArticulationConfig& config);

/// The most likely of all starts for a circle.
Arc bestCircleStart(const PoseSamples& samples, const ArticulationConfig& config);

/// Circles of `typical_radius` [m] that bend either way from a line, in the plane in which positions scatter most.
std::vector<Arc> typicalCircles(const PoseSamples& samples, const Arc& line, double typical_radius);

}  // namespace cabinet_articulation::core
