// SPDX-License-Identifier: BSD-3-Clause
#include "ros/answers/joints.h"

#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>
#include <cmath>

#include "cabinet_articulation/joints/hanging.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "geometry/message_precision.h"

namespace cabinet_articulation {
namespace {

geometry_msgs::TransformStamped transform(const Eigen::Isometry3d& T_parent_child, const std_msgs::Header& header,
                                          const std::string& parent, const std::string& child) {
  geometry_msgs::TransformStamped message = tf2::eigenToTransform(T_parent_child);
  message.header = header;
  message.header.frame_id = parent;
  message.child_frame_id = child;
  return message;
}

void addState(const core::LearnedModel& joint, sensor_msgs::JointState* state) {
  state->name.push_back(nameOf(joint));
  state->position.push_back(joint.q);
}

}  // namespace

std::string jointPrefix(const std::string& ros_namespace) {
  std::string prefix = ros_namespace.substr(std::min(ros_namespace.find_first_not_of('/'), ros_namespace.size()));
  std::replace(prefix.begin(), prefix.end(), '/', '_');
  return prefix;
}

std::vector<geometry_msgs::TransformStamped> jointTransforms(const std::vector<core::LearnedModel>& models,
                                                             const std_msgs::Header& header, const std::string& prefix) {
  std::vector<geometry_msgs::TransformStamped> transforms;
  for (const core::LearnedModel& model : models) {
    if (!isJoint(model) || !core::hangsOnKnown(model, models)) continue;
    const std::string name = prefix + "_" + std::to_string(model.id);
    const std::string parent = model.parent == 0 ? header.frame_id : prefix + "_" + std::to_string(model.parent) + "_front";
    const Eigen::Isometry3d T_parent_base = jointBase(model);
    transforms.push_back(transform(T_parent_base, header, parent, name + "_base"));
    transforms.push_back(transform(T_parent_base.inverse() * model.predict(model.q), header, name + "_base", name + "_front"));
    if (!model.name.empty())
      transforms.push_back(transform(Eigen::Isometry3d::Identity(), header, name + "_front", prefix + "_" + model.name));
  }
  return transforms;
}

sensor_msgs::JointState jointStates(const std::vector<core::LearnedModel>& models, const std_msgs::Header& header,
                                    const std::set<std::uint32_t>& changed) {
  sensor_msgs::JointState state;
  state.header = header;
  for (const core::LearnedModel& model : models) {
    const bool is_news = core::isSameStamp(model.stamp, header.stamp.toSec()) || changed.count(model.id) > 0;
    if (isJoint(model) && is_news) addState(model, &state);
  }
  return state;
}

sensor_msgs::JointState lastJointStates(const std::vector<core::LearnedModel>& models, const std::string& frame_id) {
  sensor_msgs::JointState state;
  state.header.frame_id = frame_id;
  for (const core::LearnedModel& model : models) {
    if (!isJoint(model)) continue;
    addState(model, &state);
    state.header.stamp = std::max(state.header.stamp, toStamp(model.stamp));
  }
  return state;
}

}  // namespace cabinet_articulation
