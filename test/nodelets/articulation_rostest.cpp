// SPDX-License-Identifier: BSD-3-Clause
#include <cabinet_articulation/ArticulationModelArray.h>
#include <cabinet_articulation/TrackArray.h>
#include <gtest/gtest.h>
#include <sensor_msgs/JointState.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "support/ros_probe.h"

namespace cabinet_articulation {
namespace {

using test::Recorder;
using test::spinUntil;

constexpr int kFrames = 60, kAtRest = 15;
const Eigen::Vector3d kHinge(-0.3, 0.1, 1.5);

/// The front of a door 0.4 m wide with a vertical hinge (y is down), closed facing the camera.
Eigen::Isometry3d doorPose(double q) {
  return Eigen::Translation3d(kHinge) * Eigen::AngleAxisd(q, Eigen::Vector3d::UnitY()) * Eigen::Translation3d(0.2, 0, 0) *
         Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX());
}

/// A drawer that comes out towards the camera.
Eigen::Isometry3d drawerPose(double q) {
  return Eigen::Translation3d(0.5, 0.3, 1.5 - q) * Eigen::Isometry3d(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
}

Eigen::Isometry3d wallPose(double) {
  return Eigen::Translation3d(0.5, -0.5, 2) * Eigen::Isometry3d(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
}

/// Feeds tracks that grow frame by frame, with a millimetre of noise.
class ArticulationNodelet : public testing::Test {
 protected:
  void SetUp() override {
    tracks_.resize(3);
    for (size_t i = 0; i < 3; ++i) {
      tracks_[i].id = nextId();
      tracks_[i].width = 0.4;
      tracks_[i].height = i == 1 ? 0.2 : 0.6;
    }
    ASSERT_TRUE(spinUntil([&] { return models_.connected() && joint_states_.connected() && output_.getNumSubscribers() > 0; }));
  }

  /// An id never means two tracks, not even in two tests.
  static std::uint32_t nextId() {
    static std::uint32_t id = 6;
    return ++id;
  }

  static std::string name(const core::Track& track, const std::string& what) {
    return "kitchen_left_" + std::to_string(track.id) + "_" + what;
  }

  void observe(core::Track* track, const Eigen::Isometry3d& pose, double stamp) {
    core::TrackedObservation observation;
    observation.stamp = stamp;
    observation.rectangle = {pose, track->width, track->height};
    observation.rectangle.pose.translation() += 1e-3 * Eigen::Vector3d(noise_(random_), noise_(random_), noise_(random_));
    observation.covariance.diagonal() << 1e-6, 1e-6, 1e-6, 1e-4, 1e-4, 1e-4;
    track->observations.push_back(observation);
  }

  /// Publishes the tracks as of `stamp` and returns the models.
  ArticulationModelArrayConstPtr publish(double stamp) {
    std_msgs::Header header;
    header.stamp = ros::Time(stamp);
    header.frame_id = "map";
    const size_t before = models_.messages.size();
    output_.publish(toMessage(tracks_, header));
    return spinUntil([&] { return models_.messages.size() > before; }) ? models_.messages.back() : nullptr;
  }

  /// Door and drawer rest for a second, as they do in life, and open; the models of the last frame.
  ArticulationModelArrayConstPtr play(double start) {
    ArticulationModelArrayConstPtr models;
    for (int i = 0; i < kFrames; ++i) {
      const double stamp = start + i / 15.0;
      const double opening = std::max(0.0, static_cast<double>(i - kAtRest) / (kFrames - 1 - kAtRest));
      observe(&tracks_[0], doorPose(1.4 * opening), stamp);
      observe(&tracks_[1], drawerPose(0.3 * opening), stamp);
      observe(&tracks_[2], wallPose(0), stamp);
      models = publish(stamp);
    }
    return models;
  }

  /// child frame -> stamps, in the order in which they were sent.
  std::map<std::string, std::vector<geometry_msgs::TransformStamped>> transforms() const {
    std::map<std::string, std::vector<geometry_msgs::TransformStamped>> result;
    for (const auto& message : tf_.messages)
      for (const auto& transform : message->transforms) result[transform.child_frame_id].push_back(transform);
    return result;
  }

  std::mt19937 random_{1};
  std::normal_distribution<double> noise_;
  std::vector<core::Track> tracks_;
  ros::NodeHandle nh_{"kitchen/left"};
  ros::Publisher output_ = nh_.advertise<TrackArray>("tracks", 10);
  Recorder<ArticulationModelArray> models_{"kitchen/left/models"};
  Recorder<sensor_msgs::JointState> joint_states_{"kitchen/left/joint_states"};
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

  ASSERT_FALSE(joint_states_.messages.empty());
  const sensor_msgs::JointState& joints = *joint_states_.messages.back();
  EXPECT_EQ(joints.name, (std::vector<std::string>{name(tracks_[0], "joint"), name(tracks_[1], "joint")}));
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
