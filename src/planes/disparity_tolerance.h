// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "cabinet_articulation/geometry/stereo_camera.h"

namespace cabinet_articulation::core {

/// How far from a plane a disparity may lie, as a function of the disparity (ours: paper III-B.1 notes that d depends on
/// the camera's noise). A distance of dz along the ray is d^2 / (f B) dz pixels.
class DisparityTolerance {
 public:
  DisparityTolerance(const StereoCamera& camera, double pixels, double metres, double cap)
      : pixels_(static_cast<float>(pixels)),
        per_square_(static_cast<float>(metres / camera.focalBaseline())),
        cap_(static_cast<float>(cap)) {}

  /// [px] for a surface with this disparity.
  float at(float disparity) const { return std::min(std::max(pixels_, per_square_ * disparity * disparity), cap_); }

 private:
  float pixels_, per_square_, cap_;
};

}  // namespace cabinet_articulation::core
