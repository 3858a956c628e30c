// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <image_geometry/pinhole_camera_model.h>
#include <sensor_msgs/CameraInfo.h>

#include <opencv2/core.hpp>

namespace cabinet_articulation {

/// One camera's images, rectified where its calibration demands it (as image_proc does).
class Rectifier {
 public:
  /// Returns the image itself if it is rectified already. Throws std::runtime_error for an unknown distortion model.
  cv::Mat operator()(const cv::Mat& image, const sensor_msgs::CameraInfo& info);

 private:
  image_geometry::PinholeCameraModel model_;
};

/// False if D = 0, R = 1 and P repeats K: then the raw image is the rectified one.
bool needsRectification(const sensor_msgs::CameraInfo& info);

}  // namespace cabinet_articulation
