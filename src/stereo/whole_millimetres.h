// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/stereo/depth_frame.h"

namespace cabinet_articulation::core {

/// The depth image that a camera would give which measures no better than this frame: whole millimetres, as 16UC1 in ROS, 0 where
/// nothing was measured.
cv::Mat1w wholeMillimetres(const DepthFrame& frame);

}  // namespace cabinet_articulation::core
