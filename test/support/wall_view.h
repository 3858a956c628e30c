// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <optional>
#include <random>

#include "cabinet_articulation/geometry/plane.h"
#include "cabinet_articulation/geometry/rectangle.h"
#include "cabinet_articulation/stereo/depth_view.h"

namespace cabinet_articulation {
namespace test {

/// Where a ray from the camera, with z = 1, hits a rectangle, in its frame, and at what depth.
struct Hit {
  Eigen::Vector3d at;
  double depth;
};

inline std::optional<Hit> hit(const Eigen::Vector3d& ray, const core::Rectangle& rectangle) {
  const core::Plane plane{rectangle.normal(), -rectangle.normal().dot(rectangle.center())};
  const std::optional<Eigen::Vector3d> point = plane.intersect(ray);
  if (!point) return std::nullopt;
  const Hit hit{rectangle.pose.inverse() * *point, point->z()};
  if (std::abs(hit.at.x()) > rectangle.width / 2 || std::abs(hit.at.y()) > rectangle.height / 2) return std::nullopt;
  return hit;
}

/// A front that closes an opening in a wall, as a camera at the origin sees them.
class WallView {
 public:
  static constexpr double kDepth = 0.5;  ///< [m] from the opening to what is behind it and behind the wall's end

  WallView(const core::Rectangle& opening, const core::Rectangle& wall) : opening_(opening), wall_(wall) {}

  double noise = 0;  ///< [m] sigma of the depth
  double frame = 1;  ///< [m] the front is a frame of this width around a hole

  core::DepthView at(const Eigen::Isometry3d& front, double stamp) {
    core::DepthView view;
    view.stamp = stamp;
    view.columns = 80;
    view.rows = 60;
    view.fx = view.fy = 80;
    view.cx = 39.5;
    view.cy = 29.5;
    for (int row = 0; row < view.rows; ++row)
      for (int column = 0; column < view.columns; ++column)
        view.depth.push_back(static_cast<float>(depthAlong(view.ray(column, row), front) + noise * gaussian_(random_)));
    return view;
  }

 private:
  double depthAlong(const Eigen::Vector3d& ray, const Eigen::Isometry3d& pose) const {
    const core::Rectangle front{pose, opening_.width, opening_.height};
    const std::optional<Hit> on_front = hit(ray, front), on_wall = hit(ray, wall_);
    if (on_front && isFrame(on_front->at, front)) return on_front->depth;
    if (on_wall && !hit(ray, opening_)) return on_wall->depth;
    return opening_.center().z() + kDepth;
  }

  bool isFrame(const Eigen::Vector3d& at, const core::Rectangle& front) const {
    return std::abs(at.x()) > front.width / 2 - frame || std::abs(at.y()) > front.height / 2 - frame;
  }

  core::Rectangle opening_, wall_;
  std::mt19937 random_{1};
  std::normal_distribution<double> gaussian_;
};

}  // namespace test
}  // namespace cabinet_articulation
