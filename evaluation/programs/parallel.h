// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

namespace cabinet_articulation::core::evaluation {

/// Calls work(0) .. work(count - 1), each once, on all cores. What they write must not overlap. The first exception is
/// thrown again after all threads have ended.
void parallelFor(int count, const std::function<void(int)>& work);

}  // namespace cabinet_articulation::core::evaluation
