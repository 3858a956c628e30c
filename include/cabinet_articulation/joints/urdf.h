// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "cabinet_articulation/joints/joint.h"

namespace cabinet_articulation::core {

/*
 * Learned joints as a robot description. For the front with id 3, named "fridge", with the prefix "cabinet":
 *
 *   <frame> -- fixed --> cabinet_3_base -- fridge --> cabinet_3_leaf -- fixed --> cabinet_3_front -- fixed --> cabinet_fridge
 *
 * The base is jointBase(), and the joint moves along or about its z by the q of the model. Its limits are the range that was
 * seen. The front is the model's pose, and carries a wooden panel of the front's size that lies behind it, and collides. The
 * joint's name is nameOf(); only a front that people named has the last link, which is the front again.
 *
 * The base of a front that hangs on another lies in that one's front: cabinet_2_front -- fixed --> cabinet_3_base.
 *
 * Fronts of one piece of furniture hang on one link between the frame and their bases, cabinet_<lowest id>_body. It lies in their
 * common surface, amid them, with the axes of the first front. Fronts are one piece under two conditions. First, their closed
 * surfaces are more likely one plane than two parallel or tilted ones. The likelihood is that of their distance and tilt, given
 * the covariances of both. Second, a gap of at most 0.6 m is between them: a unit whose own front was never opened. Where the
 * closed position is not known, the most likely one is taken: q = 0, q_min, or up to 0.3 rad or 0.05 m beyond.
 */

/// Throws ModelError for what is no joint or has no counterpart in URDF, and for an id or a name that is there twice. So it does
/// for a front that hangs on one that is not among them, and for names that are empty or that XML cannot hold (control
/// characters, no UTF-8). `frame` is the frame of the models, and becomes the root link; `prefix` is the first part of all other
/// names.
std::string toUrdf(const std::vector<LearnedModel>& models, const std::string& frame, const std::string& prefix);

/// Whether URDF has such a joint.
bool hasUrdf(const LearnedModel& model);

}  // namespace cabinet_articulation::core
