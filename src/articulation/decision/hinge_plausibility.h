// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "articulation/decision/candidate.h"
#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/// A hinge lies in the front's plane or close to it, and no farther from the front's centre than its edges. Planes that touch a
/// bottle or an arm here and there turn about an axis behind them. What hands leave to see of a plane turns within it. Small
/// turns leave it uncertain where their axis is. `T_reference_center`: the front's centre as seen from the observed point;
/// `sigma_edge` [m]: how uncertain the place of its edges is.
bool isImplausibleHinge(const Candidate& candidate, const Track& front, const Eigen::Isometry3d& T_reference_center,
                        double sigma_edge);

}  // namespace cabinet_articulation::core
