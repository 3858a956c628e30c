// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace cabinet_articulation::core {

/// Whether the ends of the range that was seen are ends of the way.
struct RangeEnds {
  bool min = false, max = false;
};

/// An end was seen if the front came to rest there, or turned round there more than once (ours). A hand that stops somewhere in
/// between hardly does so twice at the same place. All else was merely reached. `stamps` [s] belong to `q`.
RangeEnds seenEnds(const std::vector<double>& q, const std::vector<double>& stamps, double q_min, double q_max);

}  // namespace cabinet_articulation::core
