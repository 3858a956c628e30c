// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <image_geometry/pinhole_camera_model.h>
#include <sensor_msgs/CameraInfo.h>

#include <opencv2/core.hpp>

namespace cabinet_articulation {

/// One camera's images, rectified by image_geometry to the same bytes as by image_proc: that takes images without distortion
/// (D = 0) for rectified, whatever R and P say.
class Rectifier {
 public:
  /// Returns the image itself if it is rectified already. Throws std::invalid_argument for a sensor beyond geometry/limits.h, and
  /// std::runtime_error for a distortion model that is impossible, or
  /// unknown to the image_geometry at hand: `equidistant` (fisheye) is, before its version 1.16.
  cv::Mat operator()(const cv::Mat& image, const sensor_msgs::CameraInfo& info);

 private:
  image_geometry::PinholeCameraModel model_;
};

}  // namespace cabinet_articulation
