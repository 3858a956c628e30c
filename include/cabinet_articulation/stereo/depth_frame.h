// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "cabinet_articulation/geometry/stereo_camera.h"

namespace cabinet_articulation::core {

/// One measurement, as the stages after block matching see it. The images are views: the caller keeps the pixels alive.
struct DepthFrame {
  StereoCamera camera;
  cv::Mat1f disparity;    ///< [px] the left image's size; a pixel is valid where the value is finite and > 0
  cv::Mat1b left, right;  ///< the rectified pair; empty where the input is a depth camera
};

/// False for a depth camera, of which there is no pair to compare.
inline bool hasImages(const DepthFrame& frame) { return !frame.left.empty() && !frame.right.empty(); }

/// True for a usable disparity; false for NaN, infinities, zero and negative numbers.
inline bool isValidDisparity(float disparity) { return disparity > 0 && disparity < 1e4F; }

}  // namespace cabinet_articulation::core
