// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <tf2/buffer_core.h>
#include <tf2/exceptions.h>

#include "ros/transforms/transform_lookup.h"
#include "support/front_scene.h"

namespace cabinet_articulation::fuzz {

/// A front before a wall in images of 64x48 pixels, which cost next to nothing.
struct SmallFrame {
  test::FrontScene scene{{64, 48, 60, 60, 31, 23, 0.1, 0}, {test::facingCamera(0.05, -0.02, 0.7), 0.4, 0.3}, 1.4};
  std_msgs::Header header = test::exampleHeader();

  const core::StereoCamera& camera() const { return scene.camera; }
  sensor_msgs::CameraInfo info(bool right) const { return test::cameraInfo(camera(), right, header); }
  stereo_msgs::DisparityImage disparity() const { return scene.disparityMessage(header); }

  /// The left image, or the right one where every pixel is shifted by its disparity.
  sensor_msgs::Image image(bool right) const {
    return test::greyImage(camera().width, camera().height, header, [this, right](int u, int v) {
      const int shift = right ? static_cast<int>(scene.disparity(u, v)) : 0;
      return static_cast<std::uint8_t>(96 + (37 * (u + shift) + 59 * v + 11 * (u + shift) * v) % 101);
    });
  }

  /// [m]
  sensor_msgs::Image depth() const {
    sensor_msgs::Image image = disparity().image;
    float* out = reinterpret_cast<float*>(image.data.data());
    for (int v = 0; v < camera().height; ++v)
      for (int u = 0; u < camera().width; ++u) *out++ = static_cast<float>(scene.depth(u, v));
    return image;
  }
};

/// Where the camera is, as tf says.
inline geometry_msgs::TransformStamped exampleTransform() {
  geometry_msgs::TransformStamped transform;
  transform.header = test::exampleHeader();
  transform.header.frame_id = "map";
  transform.child_frame_id = test::exampleHeader().frame_id;
  transform.transform.translation.x = 1.5;
  transform.transform.translation.y = -2.5;
  transform.transform.translation.z = 1.25;
  transform.transform.rotation.x = transform.transform.rotation.y = transform.transform.rotation.z = 0.5;
  transform.transform.rotation.w = -0.5;
  return transform;
}

/// The same as the stages get it. Throws std::invalid_argument for what tf does not take or know.
inline Eigen::Isometry3d throughTf(const geometry_msgs::TransformStamped& message) {
  try {
    tf2_msgs::TFMessage transforms;
    transforms.transforms = {message};
    tf2::BufferCore buffer;
    addTransforms(transforms, false, &buffer);
    return lookupTransform(buffer, message.header.frame_id, message.child_frame_id, message.header.stamp);
  } catch (const tf2::TransformException& error) {
    throw std::invalid_argument(error.what());
  }
}

}  // namespace cabinet_articulation::fuzz
