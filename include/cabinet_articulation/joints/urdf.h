// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "cabinet_articulation/joints/joint.h"

namespace cabinet_articulation::core {

/*
 * Learned joints as a robot description. For the front with id 3, with the prefix "cabinet":
 *
 *   <frame> -- fixed --> cabinet_3_base -- cabinet_3_joint --> cabinet_3_leaf -- fixed --> cabinet_3_front
 *
 * The base is jointBase(), and the joint moves along or about its z by the q of the model; its limits are the range that was
 * seen. The front is the model's pose, and carries a wooden panel of the front's size that lies behind it.
 */

/// Throws ModelError for what is no joint or has no counterpart in URDF, and for an id that is there twice. So it does for names
/// that are empty or that XML cannot hold (control characters, no UTF-8). `frame` is the frame of the models, and becomes the
/// root link; `prefix` is the first part of all other names.
std::string toUrdf(const std::vector<LearnedModel>& models, const std::string& frame, const std::string& prefix);

/// Whether URDF has such a joint.
bool hasUrdf(const LearnedModel& model);

}  // namespace cabinet_articulation::core
