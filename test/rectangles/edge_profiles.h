// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <functional>
#include <limits>

#include "rectangles/edges/edge_profile.h"

namespace cabinet_articulation::core {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Residuals, as a projected grid gives them, of surfaces whose disparity relative to the plane is `disparity(x)` at x px
/// outward; NaN: none in reach. `noise`: what even the right disparity leaves unexplained.
inline EdgeProfile::Residuals profileOf(const std::function<double(double)>& disparity, double noise = 0.02) {
  EdgeProfile::Residuals result;
  result.weight.fill(1);
  for (int k = 0; k < EdgeProfile::kStrips; ++k) {
    const double d = disparity(EdgeProfile::offset(k) + EdgeProfile::kStripWidth / 2);
    for (int i = 0; i < EdgeProfile::kOffsets; ++i) {
      const double miss = i - EdgeProfile::kOnPlane - d;
      const double unexplained = noise + (0.9 - noise) * (1 - std::exp(-miss * miss / 5.6));
      result.residual[k][i] = std::isnan(d) ? 0.9F : static_cast<float>(unexplained);
    }
    result.signal[k] = 40 * std::sqrt(1 - result.residual[k][EdgeProfile::kOnPlane]);
  }
  return result;
}

}  // namespace cabinet_articulation::core
