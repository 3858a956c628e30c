// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cabinet_articulation::core {

/// [m] Usual thickness of the boards that furniture and its fronts are made of. Others have up to twice as much, or hardly any.
constexpr double kBoard = 0.018;

}  // namespace cabinet_articulation::core
