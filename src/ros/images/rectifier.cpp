// SPDX-License-Identifier: BSD-3-Clause
#include "ros/images/rectifier.h"

#include <algorithm>
#include <stdexcept>

#include "ros/checks/image_limits.h"

namespace cabinet_articulation {

cv::Mat Rectifier::operator()(const cv::Mat& image, const sensor_msgs::CameraInfo& info) {
  if (std::all_of(info.D.begin(), info.D.end(), [](double d) { return d == 0; })) return image;
  sensor_msgs::CameraInfo calibration = info;
  if (calibration.distortion_model.empty()) calibration.distortion_model = "plumb_bob";
  // image_geometry makes maps for the full sensor, of which the image may show a small region.
  requireImageArea(info.width, info.height);
  cv::Mat rectified;
  try {
    model_.fromCameraInfo(calibration);
    model_.rectifyImage(image, rectified);
  } catch (const image_geometry::Exception&) {
    throw std::runtime_error("distortion_model is '" + info.distortion_model +
                             "', expected plumb_bob, rational_polynomial, or equidistant with image_geometry 1.16 or later");
  } catch (const cv::Exception& error) {
    throw std::runtime_error("CameraInfo describes no lens that images can be rectified for: " + error.err);
  }
  return rectified;
}

}  // namespace cabinet_articulation
