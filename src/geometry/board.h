// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cabinet_articulation::core {

/// [m] Thickness of the boards that furniture and its fronts are made of. Makers of faced particle board list mostly 16, 18, 19
/// and 22 mm, none of which is more than 4 mm off (ours). Framed and insulated doors have up to twice as much, and sheet metal
/// hardly any.
constexpr double kBoard = 0.018;

}  // namespace cabinet_articulation::core
