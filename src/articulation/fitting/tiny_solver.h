// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/tiny_solver.h>

#include <type_traits>

namespace cabinet_articulation::core {

template <class Options, class = void>
struct HasFunctionTolerance : std::false_type {};
template <class Options>
struct HasFunctionTolerance<Options, std::void_t<decltype(Options::function_tolerance)>> : std::true_type {};

/// Options of a ceres::TinySolver that goes on however little a step gains. Ceres 1 always does, and has no such option.
template <class Solver>
typename Solver::Options optionsWithoutLeastGain() {
  typename Solver::Options options;
  if constexpr (HasFunctionTolerance<typename Solver::Options>::value) options.function_tolerance = 0;
  return options;
}

}  // namespace cabinet_articulation::core
