// SPDX-License-Identifier: BSD-3-Clause
#include "rectifier.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace cabinet_articulation {

bool needsRectification(const sensor_msgs::CameraInfo& info) {
  constexpr double kRotation = 1e-9, kPixel = 1e-6;
  if (std::any_of(info.D.begin(), info.D.end(), [](double d) { return d != 0; })) return true;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      const int i = 3 * row + column;
      if (std::abs(info.R[i] - (row == column)) > kRotation) return true;
      if (std::abs(info.P[4 * row + column] - info.K[i]) > kPixel) return true;
    }
  return false;
}

cv::Mat Rectifier::operator()(const cv::Mat& image, const sensor_msgs::CameraInfo& info) {
  if (!needsRectification(info)) return image;
  sensor_msgs::CameraInfo calibration = info;
  // image_geometry takes an image without distortion for rectified, whatever R and P say; a vanishing one makes it look.
  calibration.D.resize(std::max<size_t>(calibration.D.size(), 5), 0);
  if (std::all_of(calibration.D.begin(), calibration.D.end(), [](double d) { return d == 0; })) calibration.D[0] = 1e-12;
  if (calibration.distortion_model.empty()) calibration.distortion_model = "plumb_bob";
  cv::Mat rectified;
  try {
    model_.fromCameraInfo(calibration);
    model_.rectifyImage(image, rectified);
  } catch (const image_geometry::Exception&) {
    throw std::runtime_error("distortion model '" + info.distortion_model +
                             "' is not known, expected plumb_bob, rational_polynomial or equidistant");
  }
  return rectified;
}

}  // namespace cabinet_articulation
