// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/ros/simulation_conversions.h"

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

SceneTruth toMessage(const core::GroundTruth& truth, const std_msgs::Header& header) {
  SceneTruth message;
  message.header = header;
  message.scene = truth.scene;
  message.last = truth.last;
  for (const core::FrontTruth& front : truth.joints) message.joints.push_back(toJointTruth(front));
  for (const core::FrontTruth& front : truth.fixed) message.fixed.push_back(toJointTruth(front));
  return message;
}

}  // namespace cabinet_articulation
