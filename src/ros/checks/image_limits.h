// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "cabinet_articulation/geometry/limits.h"

namespace cabinet_articulation {

/// Before room is made for pixels or maps of a size that somebody else names. Throws std::invalid_argument.
inline void requireImageArea(std::uint32_t width, std::uint32_t height) {
  core::requireWithin("width", width, core::limits::kImageSide);
  core::requireWithin("height", height, core::limits::kImageSide);
  core::requireWithin("width * height", static_cast<double>(width) * height, core::limits::kImageArea);
}

}  // namespace cabinet_articulation
