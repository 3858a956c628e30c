// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "cabinet_articulation/articulation/learned_model.h"
#include "cabinet_articulation/stereo/depth_view.h"
#include "closing/front_in_view.h"

namespace cabinet_articulation::core {

/// Where the surface around a front's closed place is, as the joint's q. Narrow neighbours tell it in no single view as exactly
/// as fronts are flush. It rests, so the views tell it together: it is their median, weighted by information.
struct Surface {
  double q = 0;        ///< [m or rad]
  double sigma = 0;    ///< [m or rad] of the median
  double scatter = 0;  ///< [m or rad] of the views about that
};

/// Near q, from the points beside the front's own edges in these views, oldest first. Views within a second count as one for
/// `sigma`, since they share noise that stays where it is as long as the camera rests. Nothing where no view shows such points.
std::optional<Surface> surfaceAround(const LearnedModel& joint, const OwnEdges& edges, double q,
                                     const std::vector<const DepthView*>& views);

}  // namespace cabinet_articulation::core
