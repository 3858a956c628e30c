// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace cabinet_articulation::core {

/// Values as in ArticulationModel.msg, of the types that have a name here; all are in the registry of the models.
enum class JointType : std::uint8_t { kRigid = 0, kPrismatic = 1, kRotational = 2, kNonparametric = 3 };

}  // namespace cabinet_articulation::core
