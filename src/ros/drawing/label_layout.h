// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace cabinet_articulation {

/// A box with text, and where its middle would best be. [px]
struct LabelBox {
  cv::Size size;
  cv::Point at;
};

/// Places boxes within the image so that no two of them overlap. Each is as near as possible to where it would be best, the first
/// ones first. Nothing for those that find no room.
std::vector<std::optional<cv::Rect>> placeLabels(const std::vector<LabelBox>& boxes, const cv::Size& image);

}  // namespace cabinet_articulation
