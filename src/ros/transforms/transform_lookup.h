// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <Eigen/Geometry>
#include <string>

namespace cabinet_articulation {

/// The frame's name as tf2 wants it: without the leading slash of older drivers.
std::string tfName(const std::string& frame);

/// Puts transforms into the buffer, except those beyond geometry/limits.h. Throws std::invalid_argument for the last of these,
/// after the others are in.
void addTransforms(const tf2_msgs::TFMessage& message, bool is_static, tf2::BufferCore* buffer);

/// T_target_source at `stamp`. Equal frames need no tf. The same transforms give the same bits, whether later ones are known by
/// then (as in a bag) or not yet (as on a robot). Throws tf2::TransformException, in words, if the buffer does not know.
Eigen::Isometry3d lookupTransform(const tf2::BufferCore& buffer, const std::string& target, const std::string& source,
                                  const ros::Time& stamp);

}  // namespace cabinet_articulation
