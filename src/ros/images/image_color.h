// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "geometry/palette.h"

namespace cabinet_articulation {

/// Blue, green and red of an 8-bit image.
inline cv::Scalar imageColor(const core::palette::Rgb& color, double brightness = 1) {
  return {255 * brightness * color[2], 255 * brightness * color[1], 255 * brightness * color[0]};
}

}  // namespace cabinet_articulation
