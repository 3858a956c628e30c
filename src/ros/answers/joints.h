// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Header.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "cabinet_articulation/joints/joint.h"

namespace cabinet_articulation {

// Only joints (core::isJoint) have frames and joint states.

/// The namespace of the nodelets as the first part of frame names: "/robot/cabinet" gives "robot_cabinet".
std::string jointPrefix(const std::string& ros_namespace);

/// For every joint <prefix>_<id>_base in header.frame_id, or in the front that it hangs on, and <prefix>_<id>_front (the front at
/// its q) in the base. One with a name has that front a second time, as <prefix>_<name>. Nothing of what hangs on a front that is
/// not among the joints.
std::vector<geometry_msgs::TransformStamped> jointTransforms(const std::vector<core::LearnedModel>& models,
                                                             const std_msgs::Header& header, const std::string& prefix);

/// Joints, called core::nameOf(), that were observed in the frame of the header, with their q. Also those of `changed`: ids of
/// joints whose q changed without an observation.
sensor_msgs::JointState jointStates(const std::vector<core::LearnedModel>& models, const std_msgs::Header& header,
                                    const std::set<std::uint32_t>& changed = {});

/// All joints with their last q, whenever that was observed; the stamp is that of the newest.
sensor_msgs::JointState lastJointStates(const std::vector<core::LearnedModel>& models, const std::string& frame_id);

}  // namespace cabinet_articulation
