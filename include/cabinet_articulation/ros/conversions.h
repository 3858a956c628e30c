// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/ArticulationModelArray.h>
#include <cabinet_articulation/DepthView.h>
#include <cabinet_articulation/ExpectedFrontArray.h>
#include <cabinet_articulation/KnownFrontArray.h>
#include <cabinet_articulation/RectangleArray.h>
#include <cabinet_articulation/TrackArray.h>
#include <geometry_msgs/PoseWithCovariance.h>
#include <std_msgs/Header.h>

#include <string>
#include <vector>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/joints/prediction.h"
#include "cabinet_articulation/rectangles/detected_rectangle.h"
#include "cabinet_articulation/stereo/depth_view.h"
#include "cabinet_articulation/tracking/expected_fronts.h"
#include "cabinet_articulation/tracking/track_updates.h"

namespace cabinet_articulation {

/*
 * What the stages exchange, as messages and back. Pure functions. The frame of the poses is the caller's knowledge and
 * goes into the header. For what no stage would publish, fromMessage throws std::invalid_argument that names the element: beyond
 * geometry/limits.h, no unit quaternion, or lists whose lengths differ.
 */

Rectangle toMessage(const core::DetectedRectangle& rectangle);
RectangleArray toMessage(const std::vector<core::DetectedRectangle>& rectangles, const std_msgs::Header& header);
core::DetectedRectangle fromMessage(const Rectangle& message);
std::vector<core::DetectedRectangle> fromMessage(const RectangleArray& message);

/// The stamp and the fixed frame are those of the array that holds it. A message without cells is an empty view.
DepthView toMessage(const core::DepthView& view);
core::DepthView fromMessage(const DepthView& message);

Track toMessage(const core::TrackUpdate& update, const std::string& frame_id);
TrackArray toMessage(const std::vector<core::TrackUpdate>& updates, const std_msgs::Header& header);
core::TrackUpdate fromMessage(const Track& message);
std::vector<core::TrackUpdate> fromMessage(const TrackArray& message);

/// Whole tracks. From a message that holds only the end of one: std::invalid_argument.
Track toMessage(const core::Track& track, const std::string& frame_id);
TrackArray toMessage(const std::vector<core::Track>& tracks, const std_msgs::Header& header);
core::Track wholeTrack(const Track& message);

/// Those that can be used; `left_out` names one that cannot, and why.
std::vector<core::Track> usableTracks(const KnownFrontArray& message, std::string* left_out);

/// What a front is expected to do next, in the fixed frame of the header.
ExpectedFrontArray toMessage(const core::ExpectedFronts& expected, const std_msgs::Header& header);
core::ExpectedFront fromMessage(const ExpectedFront& message);
core::ExpectedFronts fromMessage(const ExpectedFrontArray& message);

ArticulationModel toMessage(const core::LearnedModel& model, const std::string& frame_id);
ArticulationModelArray toMessage(const std::vector<core::LearnedModel>& models, const std_msgs::Header& header);
core::LearnedModel fromMessage(const ArticulationModel& message);
std::vector<core::LearnedModel> fromMessage(const ArticulationModelArray& message);

geometry_msgs::PoseWithCovariance toMessage(const core::UncertainPose& pose);

/// Those that can be used, as usableTracks.
std::vector<core::LearnedModel> usableModels(const ArticulationModelArray& message, std::string* left_out);

}  // namespace cabinet_articulation
