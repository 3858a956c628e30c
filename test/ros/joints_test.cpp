// SPDX-License-Identifier: BSD-3-Clause
#include "ros/answers/joints.h"

#include <gtest/gtest.h>
#include <tf2_eigen/tf2_eigen.h>

#include "support/models.h"

namespace cabinet_articulation {
namespace {

std_msgs::Header headerAt(double stamp) {
  std_msgs::Header header;
  header.frame_id = "map";
  header.stamp = ros::Time(stamp);
  return header;
}

TEST(Joints, PrefixIsTheNamespaceInOneWord) {
  EXPECT_EQ(jointPrefix("/cabinet"), "cabinet");
  EXPECT_EQ(jointPrefix("/robot/cabinet"), "robot_cabinet");
  EXPECT_EQ(jointPrefix("/"), "");
  EXPECT_EQ(jointPrefix(""), "");
}

TEST(Joints, TransformsChainToTheFrontAsItIsNow) {
  const core::LearnedModel door = test::doorModel();
  const auto transforms = jointTransforms({door, test::restingModel(), test::unexplainedModel()}, headerAt(5), "cabinet");
  ASSERT_EQ(transforms.size(), 2u) << "only what is known to move has frames";
  EXPECT_EQ(transforms[0].header.frame_id, "map");
  EXPECT_EQ(transforms[0].child_frame_id, "cabinet_3_base");
  EXPECT_EQ(transforms[1].header.frame_id, "cabinet_3_base");
  EXPECT_EQ(transforms[1].child_frame_id, "cabinet_3_front");
  EXPECT_EQ(transforms[1].header.stamp, ros::Time(5));
  const Eigen::Isometry3d front = tf2::transformToEigen(transforms[0]) * tf2::transformToEigen(transforms[1]);
  EXPECT_TRUE(front.isApprox(door.predict(door.q), 1e-9));
  const core::LearnedModel garage = test::garageModel();
  const auto along_curve = jointTransforms({garage}, headerAt(5), "cabinet");
  ASSERT_EQ(along_curve.size(), 2u);
  EXPECT_TRUE(
      (tf2::transformToEigen(along_curve[0]) * tf2::transformToEigen(along_curve[1])).isApprox(garage.predict(0.2), 1e-9));
}

TEST(Joints, TransformsOfWhatHangsOnAFrontChainToThat) {
  const core::LearnedModel door = test::doorModel();
  core::LearnedModel rack = test::drawerModel();
  rack.parent = door.id;
  const auto transforms = jointTransforms({door, rack}, headerAt(5), "cabinet");
  ASSERT_EQ(transforms.size(), 4u);
  EXPECT_EQ(transforms[2].header.frame_id, "cabinet_3_front");
  EXPECT_EQ(transforms[2].child_frame_id, "cabinet_4_base");
  const Eigen::Isometry3d front = tf2::transformToEigen(transforms[2]) * tf2::transformToEigen(transforms[3]);
  EXPECT_TRUE(front.isApprox(rack.predict(rack.q), 1e-9));
  EXPECT_TRUE(jointTransforms({rack}, headerAt(5), "cabinet").empty()) << "a frame without a parent would be a tree of its own";
}

TEST(Joints, ANameIsAnotherFrameOfTheFront) {
  core::LearnedModel door = test::doorModel();
  door.name = "fridge";
  const auto transforms = jointTransforms({door, test::drawerModel()}, headerAt(5), "cabinet");
  ASSERT_EQ(transforms.size(), 5u);
  EXPECT_EQ(transforms[1].child_frame_id, "cabinet_3_front");
  EXPECT_EQ(transforms[2].header.frame_id, "cabinet_3_front");
  EXPECT_EQ(transforms[2].child_frame_id, "cabinet_fridge");
  EXPECT_EQ(transforms[2].header.stamp, ros::Time(5));
  EXPECT_TRUE(tf2::transformToEigen(transforms[2]).isApprox(Eigen::Isometry3d::Identity()));
}

TEST(Joints, StatesAreThoseObservedInTheFrame) {
  core::LearnedModel door = test::doorModel(), drawer = test::drawerModel();
  door.stamp = 5;
  drawer.stamp = 4;  // hidden in this frame
  const sensor_msgs::JointState state = jointStates({door, drawer, test::restingModel()}, headerAt(5));
  EXPECT_EQ(state.name, (std::vector<std::string>{"front_3"}));
  EXPECT_EQ(state.position, (std::vector<double>{door.q}));
  EXPECT_EQ(state.header.stamp, ros::Time(5));
}

/// As of a front that was held for shut until its place was seen empty.
TEST(Joints, StatesAreAlsoThoseThatChangedWithoutAnObservation) {
  core::LearnedModel door = test::doorModel(), drawer = test::drawerModel();
  door.stamp = 5;
  drawer.stamp = 4;
  const sensor_msgs::JointState state = jointStates({door, drawer, test::restingModel()}, headerAt(5), {drawer.id, 99});
  EXPECT_EQ(state.name, (std::vector<std::string>{"front_3", "front_4"}));
  EXPECT_EQ(state.position, (std::vector<double>{door.q, drawer.q}));
  EXPECT_EQ(state.header.stamp, ros::Time(5));
}

TEST(Joints, LastStatesAreThoseOfAll) {
  core::LearnedModel door = test::doorModel(), drawer = test::drawerModel();
  door.stamp = 5;
  drawer.stamp = 4;
  door.name = "fridge";
  const sensor_msgs::JointState state = lastJointStates({door, drawer, test::restingModel()}, "map");
  EXPECT_EQ(state.name, (std::vector<std::string>{"fridge", "front_4"}));
  EXPECT_EQ(state.position, (std::vector<double>{door.q, drawer.q}));
  EXPECT_EQ(state.header.frame_id, "map");
  EXPECT_EQ(state.header.stamp, ros::Time(5));
}

}  // namespace
}  // namespace cabinet_articulation
