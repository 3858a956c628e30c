// SPDX-License-Identifier: BSD-3-Clause
// The exported URDF in robot_state_publisher, fed with the nodelet's joint_states.
#include <cabinet_articulation/ExportUrdf.h>
#include <sensor_msgs/JointState.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/transform_listener.h>

#include <cstdio>
#include <memory>

#include "cabinet_articulation/ros/pose_conversions.h"
#include "support/moving_fronts.h"

namespace cabinet_articulation {
namespace {

using test::spinUntil;

class RobotDescription : public test::MovingFronts {
 protected:
  RobotDescription() : MovingFronts("cabinet") {}

  ExportUrdf::Response exportUrdf(const std::vector<std::uint32_t>& ids) {
    ExportUrdf exported;
    exported.request.ids = ids;
    EXPECT_TRUE(ros::service::waitForService("/cabinet/export_urdf", ros::Duration(test::kGenerous)));
    EXPECT_TRUE(ros::service::call("/cabinet/export_urdf", exported));
    return exported.response;
  }

  static std::string outputOf(const std::string& command) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
    std::string output;
    for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get())) output += static_cast<char>(c);
    return output;
  }

  std::string front(int i) const { return "cabinet_" + std::to_string(tracks_[i].id) + "_front"; }

  test::Recorder<sensor_msgs::JointState> joint_states_{"/cabinet/joint_states"};
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_{buffer_, ros::NodeHandle(), false};
};

TEST_F(RobotDescription, MovesAsTheModelsDo) {
  ASSERT_TRUE(play(100));
  const ExportUrdf::Response exported = exportUrdf({});
  ASSERT_TRUE(exported.success) << exported.message;
  EXPECT_EQ(outputOf("rosrun cabinet_articulation export_urdf __ns:=/cabinet"), exported.urdf + "\n");
  nh_.setParam("/learned_description", exported.urdf);

  // A joint that moves on, until the publisher is up and has heard of it.
  double stamp = 100 + test::kFrames / 15.0;
  ArticulationModelArrayConstPtr models;
  const auto published = [&] {
    stamp += 0.1;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Isometry3d pose = i == 0 ? test::doorPose(0.7) : i == 1 ? test::drawerPose(0.2) : test::wallPose(0);
      observe(&tracks_[i], pose, stamp);
    }
    models = publish(stamp);
    return spinUntil([&] { return models && buffer_.canTransform("map", front(0), models->header.stamp); }, 0.3);
  };
  bool heard = false;
  for (int attempt = 0; attempt < 60 && !heard; ++attempt) heard = published();
  ASSERT_TRUE(heard) << exported.urdf;
  for (int i = 0; i < 2; ++i) {
    const core::LearnedModel model = fromMessage(models->models.at(i));
    const Eigen::Isometry3d pose = tf2::transformToEigen(buffer_.lookupTransform("map", front(i), models->header.stamp));
    // The description is older than the newest model, which has learned on since.
    EXPECT_LT((pose.translation() - model.predict(model.q).translation()).norm(), 0.002) << i;
    EXPECT_LT(core::angleBetween(pose, model.predict(model.q)), 0.005) << i;
  }
  EXPECT_EQ(joint_states_.messages.back()->name.at(0), "front_" + std::to_string(tracks_[0].id));
}

TEST_F(RobotDescription, HoldsWhatWasAskedForOrSaysWhyNot) {
  play(200);
  const ExportUrdf::Response door = exportUrdf({tracks_[0].id});
  ASSERT_TRUE(door.success) << door.message;
  EXPECT_NE(door.urdf.find(front(0)), std::string::npos);
  EXPECT_EQ(door.urdf.find(front(1)), std::string::npos);
  const ExportUrdf::Response wall = exportUrdf({tracks_[2].id});
  EXPECT_FALSE(wall.success);
  EXPECT_NE(wall.message.find("has not moved enough yet"), std::string::npos) << wall.message;
  EXPECT_TRUE(wall.urdf.empty());
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "robot_description_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
