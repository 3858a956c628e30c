// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace cabinet_articulation::core::evaluation {

/// What this program has taken from the heap since its start, by any library. A program that links this file counts.
struct Allocations {
  std::int64_t count = 0, bytes = 0;
  std::int64_t largest = 0;  ///< [bytes] the largest block since the last call of allocations()
};

Allocations allocations();

}  // namespace cabinet_articulation::core::evaluation
