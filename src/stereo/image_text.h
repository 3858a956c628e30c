// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace cabinet_articulation::core {

/// "640x480 px with 8 bit and 1 channel", for error messages.
inline std::string describeImage(const cv::Mat& image) {
  if (image.empty()) return "empty";
  const int channels = image.channels();
  return std::to_string(image.cols) + "x" + std::to_string(image.rows) + " px with " + std::to_string(8 * image.elemSize1()) +
         " bit and " + std::to_string(channels) + (channels == 1 ? " channel" : " channels");
}

}  // namespace cabinet_articulation::core
