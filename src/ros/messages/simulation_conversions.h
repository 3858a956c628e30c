// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/SceneTruth.h>
#include <sensor_msgs/CameraInfo.h>
#include <std_msgs/Header.h>

#include <string>

#include "cabinet_articulation/simulation/simulated_stereo_camera.h"

namespace cabinet_articulation {

/// CameraInfos of a rectified pair: no distortion, R = 1, and the baseline in the right P[3] = -fx * baseline.
sensor_msgs::CameraInfo toLeftCameraInfo(const core::StereoCamera& camera, const std_msgs::Header& header);
sensor_msgs::CameraInfo toRightCameraInfo(const core::StereoCamera& camera, const std_msgs::Header& header);

/// `header.frame_id` must name the left optical frame, `world_frame` the one in which the simulated furniture rests.
SceneTruth toMessage(const core::GroundTruth& truth, const std_msgs::Header& header, const std::string& world_frame);

/// The truth in its own frame or in the world. Throws std::invalid_argument for any other frame.
SceneTruth inFrame(SceneTruth truth, const std::string& frame);

}  // namespace cabinet_articulation
