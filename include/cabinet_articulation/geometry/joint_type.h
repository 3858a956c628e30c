// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace cabinet_articulation::core {

/// Values as in ArticulationModel.msg. A type without a name here is JointType{value}.
enum class JointType : std::uint8_t { kRigid = 0, kPrismatic = 1, kRotational = 2, kNonparametric = 3 };

}  // namespace cabinet_articulation::core
