// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "simulation/texture_projector.h"

namespace cabinet_articulation::core {

/// A number that is linear in the image: u, v -> a u + b v + c.
struct LinearInImage {
  float a = 0, b = 0, c = 0;
};

/// The light on one surface as one camera sees it. With the ray r = (u, v, 1) in normalized coordinates, the plane's normal
/// n and distance h, and the projector at o: the surface point is p = r h / (n.r), so (n.r) (p - o) is linear in the image.
class SpanShader {
 public:
  /// `surface` in the camera's frame.
  SpanShader(const Surface& surface, int index, const PinholeView& camera, const Eigen::Isometry3d& T_projector_camera,
             double ambient, const TextureProjector& projector);

  /// Radiance of the pixels u, u + 1, ... of row v. All must see the surface.
  void shade(float u, float v, int count, float* radiance) const;

 private:
  LinearInImage x_, y_, z_;  ///< (n.r) (p - o) in the projector's axes
  LinearInImage slant_;      ///< n.r
  float lit_ = 0;            ///< reflectance times the projector's distance to the plane; 0 if it is behind
  float unlit_ = 0;          ///< radiance by ambient light
  int index_;
  float focal_, cx_, cy_;
  const TextureProjector* projector_;
};

}  // namespace cabinet_articulation::core
