// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/articulation/arc_fit.h"

namespace cabinet_articulation::core {

/// Where a fit may start: the line or circle that most positions agree on, among closed-form solutions from all poses
/// and from random pairs or triples.
Arc consensusArc(const PoseSamples& samples, PathShape shape, const ArticulationConfig& config);

/// Circles of a typical radius that bend either way from a line, in the plane in which positions scatter most.
std::vector<Arc> typicalCircles(const PoseSamples& samples, const Arc& line);

}  // namespace cabinet_articulation::core
