// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ros/drawing/model_drawing.h"

namespace cabinet_articulation {

/// Shares that are drawn as bars below the lines of a label, 0 to 1.
struct LabelGauge {
  double probability = 0;  ///< of the type
  double opening = 0;      ///< from closed to widest, or of the range seen
};

/// What is written beside a front.
struct OverlayLabel {
  std::string text;  ///< a comma begins the second line
  cv::Point at;      ///< [px] the front's centre
  Color color{};     ///< the front's
  std::optional<LabelGauge> gauge;
};

/// The gauge of a joint; nothing for what is none.
std::optional<LabelGauge> gaugeOf(const core::LearnedModel& model);

/// Draws the labels on dark boxes that do not overlap and lie within the image, those with a gauge first. Where a box lies beside
/// its front, a line leads to it. What finds no room is left out.
void drawLabels(std::vector<OverlayLabel> labels, cv::Mat3b* image);

}  // namespace cabinet_articulation
