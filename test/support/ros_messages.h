// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>
#include <stereo_msgs/DisparityImage.h>

#include <functional>
#include <string>

#include "cabinet_articulation/geometry/stereo_camera.h"

namespace cabinet_articulation {
namespace test {

/// The camera of the synthetic messages.
inline core::StereoCamera smallCamera() { return {320, 240, 300, 300, 155, 118, 0.08, 0}; }

inline sensor_msgs::CameraInfo cameraInfo(const core::StereoCamera& camera, bool right, const std_msgs::Header& header = {}) {
  sensor_msgs::CameraInfo info;
  info.header = header;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0);
  const double cx = camera.cx - (right ? camera.cx_difference : 0);
  info.K = {camera.fx, 0, cx, 0, camera.fy, camera.cy, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {camera.fx, 0, cx, right ? -camera.focalBaseline() : 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
  return info;
}

inline std_msgs::Header exampleHeader() {
  std_msgs::Header header;
  header.frame_id = "camera";
  header.stamp = ros::Time(5, 6);
  return header;
}

/// A grey image whose pixels are given by a function of u and v.
inline sensor_msgs::Image greyImage(int width, int height, const std_msgs::Header& header,
                                    const std::function<std::uint8_t(int, int)>& pixel) {
  sensor_msgs::Image image;
  image.header = header;
  image.encoding = sensor_msgs::image_encodings::MONO8;
  image.width = static_cast<std::uint32_t>(width);
  image.height = static_cast<std::uint32_t>(height);
  image.step = image.width;
  image.data.reserve(static_cast<size_t>(width) * height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) image.data.push_back(pixel(u, v));
  return image;
}

/// A disparity image whose pixels are given by a function of u and v.
inline stereo_msgs::DisparityImage disparityImage(const core::StereoCamera& camera, const std_msgs::Header& header,
                                                  const std::function<float(int, int)>& disparity) {
  stereo_msgs::DisparityImage message;
  message.header = header;
  message.f = static_cast<float>(camera.fx);
  message.T = static_cast<float>(camera.baseline);
  message.max_disparity = 127;
  message.image.header = header;
  message.image.encoding = sensor_msgs::image_encodings::TYPE_32FC1;
  message.image.width = static_cast<std::uint32_t>(camera.width);
  message.image.height = static_cast<std::uint32_t>(camera.height);
  message.image.step = message.image.width * sizeof(float);
  message.image.data.resize(static_cast<size_t>(message.image.step) * camera.height);
  float* out = reinterpret_cast<float*>(message.image.data.data());
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) *out++ = disparity(u, v);
  return message;
}

/// The message of the std::exception that `work` throws; empty if it throws nothing.
template <class Work>
std::string errorOf(const Work& work) {
  try {
    work();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace test
}  // namespace cabinet_articulation
