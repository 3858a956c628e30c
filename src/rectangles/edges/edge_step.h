// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rectangles/edges/edge_profile.h"
#include "rectangles/edges/side_face.h"

namespace cabinet_articulation::core {

/// Where a profile leaves the plane.
struct EdgeStep {
  double offset = 0;    ///< [px] outward from where the edge was
  double inside = 0;    ///< mean log residual on the plane just inside
  double contrast = 0;  ///< how much the plane explains the strips outside worse; 0: no edge
  bool face = false;    ///< what begins there is a side face
};

/// The innermost place from which on the strips no longer lie on the plane (ours). A strip has left it if the plane
/// explains it worse than the strips inside, or if another depth explains it better. `face`: that can be
/// seen at this edge.
EdgeStep findStep(const EdgeProfile::Residuals& residuals, const SideFace& face = {});

}  // namespace cabinet_articulation::core
