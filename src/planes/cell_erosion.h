// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

namespace cabinet_articulation::core {

/// Erosion of a binary image of 0 and 255 by 3x3 cells; what lies outside of the image counts as set (ours: the same cells as
/// OpenCV's, which takes memory from the heap fifteen times a call). Only `rows` are eroded, the others of `eroded` are not
/// written. It is reused if it has the right size.
void erode(const cv::Mat1b& cells, const cv::Range& rows, cv::Mat1b* eroded);

}  // namespace cabinet_articulation::core
