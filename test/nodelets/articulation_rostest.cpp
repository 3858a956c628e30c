// SPDX-License-Identifier: BSD-3-Clause
#include <sensor_msgs/JointState.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "cabinet_articulation/ros/pose_conversions.h"
#include "support/moving_fronts.h"

namespace cabinet_articulation {
namespace {

using test::doorPose;
using test::drawerPose;
using test::kFrames;
using test::kHinge;
using test::Recorder;
using test::spinUntil;

class ArticulationNodelet : public test::MovingFronts {
 protected:
  ArticulationNodelet() : MovingFronts("kitchen/left") {}

  void SetUp() override {
    MovingFronts::SetUp();
    ASSERT_TRUE(spinUntil([&] { return joint_states_->connected(); }));
  }

  static std::string name(const core::Track& track, const std::string& what) {
    return "kitchen_left_" + std::to_string(track.id) + "_" + what;
  }

  static std::string jointOf(const core::Track& track) { return "front_" + std::to_string(track.id); }

  /// child frame -> stamps, in the order in which they were sent.
  std::map<std::string, std::vector<geometry_msgs::TransformStamped>> transforms() const {
    std::map<std::string, std::vector<geometry_msgs::TransformStamped>> result;
    for (const auto& message : tf_.messages)
      for (const auto& transform : message->transforms) result[transform.child_frame_id].push_back(transform);
    return result;
  }

  std::optional<Recorder<sensor_msgs::JointState>> joint_states_{std::in_place, "kitchen/left/joint_states"};
  Recorder<tf2_msgs::TFMessage> tf_{"/tf"};
};

TEST_F(ArticulationNodelet, LearnsADoorADrawerAndAWall) {
  const ArticulationModelArrayConstPtr models = play(100);
  ASSERT_TRUE(models);
  ASSERT_EQ(models->models.size(), 3u);
  EXPECT_EQ(models->header.frame_id, "map");
  const ArticulationModel& door = models->models[0];
  EXPECT_EQ(door.id, tracks_[0].id);
  EXPECT_EQ(door.type, ArticulationModel::ROTATIONAL);
  EXPECT_GT(door.probabilities.at(ArticulationModel::ROTATIONAL), 0.95);
  EXPECT_GT(std::abs(fromMessage(door.axis).y()), std::cos(0.0175));
  const Eigen::Vector3d off_axis = fromMessage(door.axis_point) - kHinge;
  EXPECT_LT(std::hypot(off_axis.x(), off_axis.z()), 0.005);
  EXPECT_NEAR(door.q, 1.4, 0.02);
  const ArticulationModel& drawer = models->models[1];
  EXPECT_EQ(drawer.type, ArticulationModel::PRISMATIC);
  EXPECT_LT(fromMessage(drawer.axis).z(), -std::cos(0.0175));
  EXPECT_NEAR(drawer.q, 0.3, 0.005);
  EXPECT_FALSE(models->models[2].moved);

  ASSERT_FALSE(joint_states_->messages.empty());
  const sensor_msgs::JointState& joints = *joint_states_->messages.back();
  EXPECT_EQ(joints.name, (std::vector<std::string>{jointOf(tracks_[0]), jointOf(tracks_[1])}));
  EXPECT_EQ(joints.header.stamp, models->header.stamp);
  EXPECT_EQ(joints.position[0], door.q);
}

TEST_F(ArticulationNodelet, BroadcastsFramesOfWhatMovedAndOnlyOnceAStamp) {
  const ArticulationModelArrayConstPtr models = play(200);
  publish(200 + (kFrames - 1) / 15.0);  // the same frame again
  ASSERT_TRUE(models);
  ASSERT_TRUE(spinUntil([&] { return transforms().count(name(tracks_[1], "front")) > 0; }));
  test::spinFor(0.3);
  const auto sent = transforms();
  EXPECT_EQ(sent.count(name(tracks_[2], "base")), 0u) << "the wall never moved";
  for (const auto& frame : sent) {
    std::set<ros::Time> stamps;
    for (const auto& transform : frame.second) EXPECT_TRUE(stamps.insert(transform.header.stamp).second) << frame.first;
  }
  const auto& base = sent.at(name(tracks_[0], "base")).back();
  const auto& front = sent.at(name(tracks_[0], "front")).back();
  EXPECT_EQ(base.header.frame_id, "map");
  EXPECT_EQ(front.header.frame_id, name(tracks_[0], "base"));
  EXPECT_EQ(front.header.stamp, models->header.stamp);
  const Eigen::Isometry3d T_map_base = tf2::transformToEigen(base);
  EXPECT_GT(std::abs(T_map_base.linear().col(2).y()), std::cos(0.0175)) << "z along the axis";
  const Eigen::Isometry3d T_map_front = T_map_base * tf2::transformToEigen(front);
  EXPECT_LT((T_map_front.translation() - doorPose(1.4).translation()).norm(), 0.005);
}

TEST_F(ArticulationNodelet, TellsANewSubscriberWhereAllJointsWereLeft) {
  ASSERT_TRUE(play(250));
  // The last frame shows the door alone.
  observe(&tracks_[0], doorPose(1.4), 260);
  ASSERT_TRUE(publish(260));
  joint_states_.reset();
  joint_states_.emplace("kitchen/left/joint_states");
  ASSERT_TRUE(spinUntil([&] { return !joint_states_->messages.empty(); }));
  const sensor_msgs::JointState& left = *joint_states_->messages[0];
  for (int i = 0; i < 2; ++i) {
    const auto joint = std::find(left.name.begin(), left.name.end(), jointOf(tracks_[i]));
    ASSERT_NE(joint, left.name.end()) << i;
    EXPECT_NEAR(left.position.at(static_cast<size_t>(joint - left.name.begin())), i == 0 ? 1.4 : 0.3, 0.02) << i;
  }
  EXPECT_EQ(left.header.stamp, ros::Time(260));
}

TEST_F(ArticulationNodelet, ForgetsWhatIsNoLongerTracked) {
  play(300);
  const std::string gone = name(tracks_[0], "front");
  tracks_.erase(tracks_.begin());
  const double stamp = 300 + kFrames / 15.0;
  observe(&tracks_[0], drawerPose(0.3), stamp);
  const ArticulationModelArrayConstPtr models = publish(stamp);
  ASSERT_TRUE(models);
  ASSERT_EQ(models->models.size(), 2u);
  EXPECT_EQ(models->models[0].id, tracks_[0].id);
  ASSERT_TRUE(spinUntil([&] {
    const auto sent = transforms();
    return sent.count(name(tracks_[0], "front")) > 0 &&
           sent.at(name(tracks_[0], "front")).back().header.stamp == models->header.stamp;
  }));
  EXPECT_LT(transforms().at(gone).back().header.stamp, models->header.stamp) << "its frames stopped";
}

TEST_F(ArticulationNodelet, StartsAfreshWhenTheClockIsSetBack) {
  play(1000);
  for (core::Track& track : tracks_) track.observations.clear();
  const ArticulationModelArrayConstPtr models = play(500);
  ASSERT_TRUE(models);
  EXPECT_EQ(models->models[0].type, ArticulationModel::ROTATIONAL);
  EXPECT_EQ(models->models[0].observations, static_cast<unsigned>(kFrames));
  ASSERT_TRUE(spinUntil([&] { return transforms().at(name(tracks_[0], "front")).back().header.stamp == models->header.stamp; }));
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "articulation_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
