// SPDX-License-Identifier: BSD-3-Clause
#include "ros/messages/simulation_conversions.h"

#include <gtest/gtest.h>

#include "cabinet_articulation/ros/image_conversions.h"
#include "cabinet_articulation/ros/pose_conversions.h"

namespace cabinet_articulation {
namespace {

std_msgs::Header exampleHeader() {
  std_msgs::Header header;
  header.frame_id = "optical";
  header.stamp = ros::Time(1700000000, 123456789);
  return header;
}

TEST(SimulationConversions, CameraInfosDescribeTheRectifiedPair) {
  const core::StereoCamera camera{640, 480, 690, 685, 322, 236, 0.09, 3};
  const sensor_msgs::CameraInfo left = toLeftCameraInfo(camera, exampleHeader());
  const sensor_msgs::CameraInfo right = toRightCameraInfo(camera, exampleHeader());
  EXPECT_DOUBLE_EQ(right.P[3], -690 * 0.09);
  EXPECT_EQ(left.P[3], 0);
  EXPECT_EQ(left.header, exampleHeader());
  EXPECT_EQ(right.header, exampleHeader());
  for (const sensor_msgs::CameraInfo& info : {left, right})
    for (const double d : info.D) EXPECT_EQ(d, 0);
  const core::StereoCamera back = toStereoCamera(left, right, "left", "right");
  EXPECT_EQ(back.width, camera.width);
  EXPECT_EQ(back.height, camera.height);
  EXPECT_DOUBLE_EQ(back.fx, camera.fx);
  EXPECT_DOUBLE_EQ(back.fy, camera.fy);
  EXPECT_DOUBLE_EQ(back.cx, camera.cx);
  EXPECT_DOUBLE_EQ(back.cy, camera.cy);
  EXPECT_DOUBLE_EQ(back.baseline, camera.baseline);
  EXPECT_DOUBLE_EQ(back.cx_difference, camera.cx_difference);
}

TEST(SimulationConversions, TruthKeepsEveryFront) {
  const core::SimulatedStereoCamera camera{core::SimulationConfig()};
  core::GroundTruth truth = camera.truth(60);
  truth.last = true;
  const SceneTruth message = toMessage(truth, exampleHeader(), "world");
  EXPECT_EQ(message.header, exampleHeader());
  EXPECT_EQ(message.scene, "kitchen");
  EXPECT_TRUE(message.last);
  ASSERT_EQ(message.joints.size(), truth.joints.size());
  ASSERT_EQ(message.fixed.size(), truth.fixed.size());
  for (size_t i = 0; i < truth.joints.size(); ++i) {
    const core::FrontTruth& front = truth.joints[i];
    const JointTruth& joint = message.joints[i];
    EXPECT_EQ(joint.name, front.name);
    EXPECT_EQ(joint.type, static_cast<int>(front.type));
    EXPECT_TRUE(fromMessage(joint.pose).isApprox(front.rectangle.pose, 1e-9));
    EXPECT_EQ(joint.width, front.rectangle.width);
    EXPECT_EQ(joint.height, front.rectangle.height);
    EXPECT_EQ(fromMessage(joint.axis), front.axis);
    EXPECT_EQ(fromMessage(joint.axis_point), front.axis_point);
    EXPECT_EQ(joint.q, front.q);
    EXPECT_EQ(joint.q_min, 0);
    EXPECT_EQ(joint.q_max, front.q_max);
  }
  EXPECT_GT(message.joints[0].q, 0.1) << "the drawer is open in this frame";
  for (const JointTruth& fixed : message.fixed) EXPECT_EQ(fixed.type, 0) << "rigid";
}

TEST(SimulationConversions, TruthInTheWorldDoesNotMoveWithTheCamera) {
  core::SimulationConfig config;
  config.camera_motion = 0.2;
  const core::SimulatedStereoCamera camera{config};
  const auto truthAt = [&](int frame) { return toMessage(camera.truth(frame), exampleHeader(), "world"); };
  const SceneTruth first = inFrame(truthAt(0), "world"), later = inFrame(truthAt(40), "world");
  EXPECT_EQ(later.header.frame_id, "world");
  EXPECT_FALSE(fromMessage(truthAt(0).fixed[0].pose).isApprox(fromMessage(truthAt(40).fixed[0].pose), 1e-3));
  EXPECT_TRUE(fromMessage(first.fixed[0].pose).isApprox(fromMessage(later.fixed[0].pose), 1e-9));
  EXPECT_TRUE(fromMessage(first.joints[1].axis).isApprox(fromMessage(later.joints[1].axis), 1e-9));
  EXPECT_TRUE(fromMessage(first.joints[1].axis_point).isApprox(fromMessage(later.joints[1].axis_point), 1e-9));
  EXPECT_EQ(inFrame(truthAt(40), exampleHeader().frame_id).joints[0].pose, truthAt(40).joints[0].pose);
  EXPECT_THROW(inFrame(truthAt(0), "map"), std::invalid_argument);
}

}  // namespace
}  // namespace cabinet_articulation
