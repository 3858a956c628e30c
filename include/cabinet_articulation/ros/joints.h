// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Header.h>

#include <string>
#include <vector>

#include "cabinet_articulation/articulation/articulation_learner.h"

namespace cabinet_articulation {

/// True for a front that moved in a way that one of the joint types describes. Only these get frames and joint states.
bool isJoint(const core::LearnedModel& model);

/// The namespace of the nodelets as the first part of frame and joint names: "/robot/cabinet" gives "robot_cabinet".
std::string jointPrefix(const std::string& ros_namespace);

/// The frame that rests: at the axis point (rotational) or at the front with q = 0 (prismatic), z along the axis.
Eigen::Isometry3d jointBase(const core::LearnedModel& model);

/// For every joint <prefix>_<id>_base in header.frame_id and <prefix>_<id>_front (the front at its q) in the base.
std::vector<geometry_msgs::TransformStamped> jointTransforms(const std::vector<core::LearnedModel>& models,
                                                             const std_msgs::Header& header, const std::string& prefix);

/// Joints <prefix>_<id>_joint that were observed in the frame of the header, with their q.
sensor_msgs::JointState jointStates(const std::vector<core::LearnedModel>& models, const std_msgs::Header& header,
                                    const std::string& prefix);

}  // namespace cabinet_articulation
