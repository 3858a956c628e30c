// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

namespace cabinet_articulation::core {

/// Closes holes of up to three pixels in a row or column whose two ends agree to within a pixel (ours: depth cameras miss
/// small spots all over a surface, and each would count against the plane it lies in). Gaps between surfaces and wider holes
/// stay. `filled` is reused if it has the right size; it must not be `disparity`.
void fillHoles(const cv::Mat1f& disparity, cv::Mat1f* filled);

}  // namespace cabinet_articulation::core
