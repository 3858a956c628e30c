// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/geometry/plane.h"

#include <cmath>

namespace cabinet_articulation::core {
namespace {
constexpr double kThroughCentre = 1e-9;  ///< [m] a plane nearer to the camera's centre than this has no image
}

std::optional<Eigen::Vector3d> Plane::intersect(const Eigen::Vector3d& ray) const {
  const double approach = normal.dot(ray);
  const double scale = -offset / approach;
  if (!std::isfinite(scale) || scale <= 0) return std::nullopt;
  return Eigen::Vector3d(scale * ray);
}

// With p = z r(u, v): n.p + offset = 0 gives 1 / z = -n.r / offset, and disparity = f B / z is linear in u and v.
std::optional<DisparityPlane> toDisparityPlane(const Plane& plane, const StereoCamera& camera) {
  if (!(std::abs(plane.offset) > kThroughCentre)) return std::nullopt;
  const double scale = -camera.focalBaseline() / plane.offset;
  DisparityPlane image;
  image.a = scale * plane.normal.x() / camera.fx;
  image.b = scale * plane.normal.y() / camera.fy;
  image.c = scale * plane.normal.z() - image.a * camera.cx - image.b * camera.cy;
  return image;
}

std::optional<Plane> toPlane(const DisparityPlane& image, const StereoCamera& camera) {
  const Eigen::Vector3d scaled(image.a * camera.fx, image.b * camera.fy, image.at(camera.cx, camera.cy));
  const double length = scaled.norm();
  if (!(length > kThroughCentre) || !std::isfinite(length)) return std::nullopt;
  // n.r * (-f B / offset) = disparity > 0 in front of the camera, so a positive offset needs n = -scaled / length.
  Plane plane;
  plane.normal = -scaled / length;
  plane.offset = camera.focalBaseline() / length;
  return plane;
}

}  // namespace cabinet_articulation::core
