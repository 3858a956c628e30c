// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "closing/closed_place.h"

namespace cabinet_articulation::core {

/// Where a front rests, from views near where it is closed, and in how many of them it does.
struct RestPlace {
  Correction place;
  int views = 0;
};

/// The place c that explains what was measured best (maximum a posteriori by EM from the likeliest measurement; ours). In each
/// view the front is either at c, or uniformly anywhere farther open, or the view is wrong. So views of a front that begins to
/// open do not pull its closed place along. `measured` and `surface`, which c is near to, count as openings: growing outwards.
/// `reach`: how far it may open. Nothing without a measurement.
std::optional<RestPlace> innermostRest(const std::vector<Correction>& measured, const Correction& surface, double reach);

}  // namespace cabinet_articulation::core
