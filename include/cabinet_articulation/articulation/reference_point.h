// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/articulation/front_poses.h"

namespace cabinet_articulation::core {

/// The point of a front of the given size whose positions have the least noise about a circle, measured by the way they
/// come (ours; a point far from the hinge is seen better than the centre, half of whose error comes from the edge at the
/// hinge). The centre where the size hardly varies, once the front was seen more than a few times. `preferred` (may be null)
/// is kept unless another is clearly better.
ReferencePoint bestReferencePoint(const FrontPoses& poses, double width, double height, const ReferencePoint* preferred,
                                  const ArticulationConfig& config);

}  // namespace cabinet_articulation::core
