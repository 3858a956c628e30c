// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/geometry/stereo_camera.h"
#include "cabinet_articulation/rectangles/detected_rectangle.h"

namespace cabinet_articulation {

/// Draws into the left camera's image (BGR): every rectangle of the frame, and every model's front with its id. A joint has its
/// axis, the predicted fronts over the range, and the way from q = 0 to the opening now. Its label has gauges of the type's
/// probability and of the opening. ROS-free; rectangles and models are in the left optical frame. What lies behind the camera is
/// cut off.
void drawOverlay(const core::StereoCamera& camera, const std::vector<core::DetectedRectangle>& rectangles,
                 const std::vector<core::LearnedModel>& models, cv::Mat3b* image);

}  // namespace cabinet_articulation
