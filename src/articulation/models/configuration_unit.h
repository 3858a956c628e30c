// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace cabinet_articulation::core {

/// What q counts. A joint whose q is an angle turns about an axis.
enum class ConfigurationUnit : std::uint8_t { kMetre, kRadian };

}  // namespace cabinet_articulation::core
