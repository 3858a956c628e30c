// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/articulation/learned_model.h"
#include "closing/surface_plane.h"

namespace cabinet_articulation::core {

/*
 * The geometry of closing: which q brings a joint's front into a plane. A drawer gets there by going along its normal, a door by
 * turning about an axis that is parallel to its plane. So the offset of the plane tells the q of a drawer, and its direction that
 * of a door. The latter does not depend on how well the hinge's place is known.
 */

/// Whether the joint brings its front from one plane into another, and is of a kind that is known to close so.
bool leavesItsPlane(const LearnedModel& joint);

/// Configurations and how certain they are.
struct Correction {
  double q = 0;      ///< to be added
  double sigma = 0;  ///< of the plane's noise
};

/// From q to where the front lies in a plane that is given in the frame of the front at q.
Correction correctionTo(const SurfacePlane& plane, const LearnedModel& joint, double q);

/// The same for a front that was somewhere as a whole: the q that brings the front into the plane of `closed`.
double configurationInPlaneOf(const Rectangle& closed, const LearnedModel& joint);

/// Whether a front that is closed at q has opened outwards in all that was seen of it, but for noise. Nothing opens into its
/// cabinet, and nothing goes on beyond where it is closed.
bool opensOutwardsFrom(const LearnedModel& joint, double q);

}  // namespace cabinet_articulation::core
