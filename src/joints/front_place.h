// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "cabinet_articulation/joints/known_fronts.h"

namespace cabinet_articulation::core {

/// [m or rad] A front may go so far beyond what was seen of its way: 0.1 m or 0.3 rad (ours).
double beyondSeen(const LearnedModel& model);

/// [m] between two models of one front, nothing if they are of two. Fronts are the same if one comes to lie where the other was
/// seen. Both have the same outer side (within 0.39 rad, as the tracker has it). The centres are within 0.05 m but less than 0.4
/// of the shorter side, and the sides differ by at most 0.05 m. A side of 0 is unknown and fits any. The way of each is what was
/// seen, and beyondSeen(). Numbers do not count. Both models are in one frame: that of the world, or that of one parent. One that
/// hangs on a front is never one that hangs on the world.
std::optional<double> samePlace(const LearnedModel& a, const LearnedModel& b);

/// Whether a front is the one that was forgotten, by its place as samePlace() has it. What hung on another front is compared with
/// the parent where that was at that time. `all` holds the parents of `model`. A forgotten front whose parent was not known is
/// like none.
bool isSameFront(const ForgottenFront& forgotten, const LearnedModel& model, const std::vector<LearnedModel>& all);

/// Rotation from the frame of `source`'s front to that of `target`'s: both describe one front, but from other edges, maybe. What
/// hangs on it rests where it is in the front. So a map that lies elsewhere a day later does not move it.
Eigen::Isometry3d turnBetween(const LearnedModel& target, const LearnedModel& source);

}  // namespace cabinet_articulation::core
