// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "cabinet_articulation/rectangles/detected_rectangle.h"
#include "scores/detection_score.h"

namespace cabinet_articulation::core::evaluation {

/// The left image, or the depth image where there is no pair, and the score. The true front is green, the rectangle that
/// overlaps it best red, and all others blue.
cv::Mat3b drawFailure(const Frame& frame, const StereoCamera& camera, const Rectangle& truth,
                      const std::vector<DetectedRectangle>& rectangles, const DetectionScore& score);

}  // namespace cabinet_articulation::core::evaluation
