// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "cabinet_articulation/geometry/rectangle.h"
#include "support/models.h"
#include "support/ros_messages.h"

namespace cabinet_articulation {
namespace test {

/// A rectangular front that faces the camera, hanging free in front of a wall. Noise-free.
struct FrontScene {
  core::StereoCamera camera = smallCamera();
  core::Rectangle front{facingCamera(0.05, -0.02, 1.2), 0.4, 0.3};
  double wall = 1.8;  ///< [m] distance of the wall

  double depth(int u, int v) const {
    const Eigen::Vector3d p = front.center().z() * camera.ray(u, v) - front.center();
    const bool on_front = std::abs(p.x()) < front.width / 2 && std::abs(p.y()) < front.height / 2;
    return on_front ? front.center().z() : wall;
  }

  float disparity(int u, int v) const { return static_cast<float>(camera.disparity(depth(u, v))); }

  stereo_msgs::DisparityImage disparityMessage(const std_msgs::Header& header) const {
    return disparityImage(camera, header, [this](int u, int v) { return disparity(u, v); });
  }
};

}  // namespace test
}  // namespace cabinet_articulation
