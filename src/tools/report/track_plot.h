// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "cabinet_articulation/articulation/articulation_learner.h"

namespace cabinet_articulation {

/// The charts of one log as a picture: observations and axis from above and from the side, openings, and the probabilities of the
/// types. These are as they were after each of the observations. Upwards is the axis of what turns, else -y, as in a camera's
/// frame.
cv::Mat3b plotTrack(const core::Track& track, const core::ArticulationConfig& config, const std::string& title);

}  // namespace cabinet_articulation
