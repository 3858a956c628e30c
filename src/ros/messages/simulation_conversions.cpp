// SPDX-License-Identifier: BSD-3-Clause
#include "ros/messages/simulation_conversions.h"

#include <stdexcept>

#include "cabinet_articulation/ros/pose_conversions.h"

namespace cabinet_articulation {
namespace {

JointTruth toJointTruth(const core::FrontTruth& front) {
  JointTruth message;
  message.name = front.name;
  message.type = static_cast<std::uint8_t>(front.type);
  message.pose = toMessage(front.rectangle.pose);
  message.width = front.rectangle.width;
  message.height = front.rectangle.height;
  message.axis = toVector(front.axis);
  message.axis_point = toPoint(front.axis_point);
  message.q = front.q;
  message.q_max = front.q_max;
  return message;
}

}  // namespace

sensor_msgs::CameraInfo toLeftCameraInfo(const core::StereoCamera& camera, const std_msgs::Header& header) {
  sensor_msgs::CameraInfo info;
  info.header = header;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
  return info;
}

sensor_msgs::CameraInfo toRightCameraInfo(const core::StereoCamera& camera, const std_msgs::Header& header) {
  sensor_msgs::CameraInfo info = toLeftCameraInfo(camera, header);
  info.K[2] = info.P[2] = camera.cx - camera.cx_difference;
  info.P[3] = -camera.focalBaseline();
  return info;
}

SceneTruth toMessage(const core::GroundTruth& truth, const std_msgs::Header& header, const std::string& world_frame) {
  SceneTruth message;
  message.header = header;
  message.scene = truth.scene;
  message.camera.header.stamp = header.stamp;
  message.camera.header.frame_id = world_frame;
  message.camera.pose = toMessage(truth.T_world_camera);
  message.last = truth.last;
  for (const core::FrontTruth& front : truth.joints) message.joints.push_back(toJointTruth(front));
  for (const core::FrontTruth& front : truth.fixed) message.fixed.push_back(toJointTruth(front));
  return message;
}

SceneTruth inFrame(SceneTruth truth, const std::string& frame) {
  if (frame == truth.header.frame_id) return truth;
  if (frame != truth.camera.header.frame_id)
    throw std::invalid_argument("the truth is known in '" + truth.header.frame_id + "' and in '" + truth.camera.header.frame_id +
                                "', not in '" + frame + "'");
  truth.header.frame_id = frame;
  const Eigen::Isometry3d T_world_camera = fromMessage(truth.camera.pose);
  for (auto* fronts : {&truth.joints, &truth.fixed}) {
    for (JointTruth& front : *fronts) {
      front.pose = toMessage(T_world_camera * fromMessage(front.pose));
      front.axis = toVector(T_world_camera.linear() * fromMessage(front.axis));
      front.axis_point = toPoint(T_world_camera * fromMessage(front.axis_point));
    }
  }
  return truth;
}

}  // namespace cabinet_articulation
