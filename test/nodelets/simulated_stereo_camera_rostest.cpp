// SPDX-License-Identifier: BSD-3-Clause
// simulated_stereo_camera.test loads a camera (scene `drawer`, 20 Hz, waits for subscribers) and an empty manager.
#include <cabinet_articulation/SceneTruth.h>
#include <gtest/gtest.h>
#include <message_filters/subscriber.h>
#include <message_filters/time_synchronizer.h>
#include <nodelet/NodeletLoad.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Log.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/transform_listener.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "cabinet_articulation/ros/image_conversions.h"
#include "cabinet_articulation/ros/pose_conversions.h"

namespace cabinet_articulation {
namespace {

/// Spins until `done` or until time is up; tells which.
bool spinUntil(const std::function<bool()>& done, double seconds) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
  while (ros::ok() && !done() && ros::WallTime::now() < end) {
    ros::spinOnce();
    ros::WallDuration(0.005).sleep();
  }
  return done();
}

struct Frame {
  sensor_msgs::ImageConstPtr left, right;
  sensor_msgs::CameraInfoConstPtr left_info, right_info;
};

/// All messages of one run, in the order in which they come.
class Recorder {
 public:
  explicit Recorder(ros::NodeHandle nh)
      : left_(nh, "left/image_raw", 10),
        right_(nh, "right/image_raw", 10),
        left_info_(nh, "left/camera_info", 10),
        right_info_(nh, "right/camera_info", 10),
        synchronizer_(left_, right_, left_info_, right_info_, 10) {
    synchronizer_.registerCallback(boost::bind(&Recorder::onFrame, this, boost::placeholders::_1, boost::placeholders::_2,
                                               boost::placeholders::_3, boost::placeholders::_4));
    truth_ = nh.subscribe<SceneTruth>("truth", 100, [this](const SceneTruth::ConstPtr& truth) { truths.push_back(truth); });
  }

  std::vector<Frame> frames;
  std::vector<SceneTruth::ConstPtr> truths;

 private:
  void onFrame(const sensor_msgs::ImageConstPtr& left, const sensor_msgs::ImageConstPtr& right,
               const sensor_msgs::CameraInfoConstPtr& left_info, const sensor_msgs::CameraInfoConstPtr& right_info) {
    frames.push_back({left, right, left_info, right_info});
  }

  message_filters::Subscriber<sensor_msgs::Image> left_, right_;
  message_filters::Subscriber<sensor_msgs::CameraInfo> left_info_, right_info_;
  message_filters::TimeSynchronizer<sensor_msgs::Image, sensor_msgs::Image, sensor_msgs::CameraInfo, sensor_msgs::CameraInfo>
      synchronizer_;
  ros::Subscriber truth_;
};

// One test from the first subscriber to the end of the script, since the camera starts only once.
TEST(SimulatedStereoCamera, ShowsTheWholeMotionToItsSubscribers) {
  ros::NodeHandle nh("stereo");
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener(buffer);
  {
    int early = 0;
    const ros::Subscriber truth_only = nh.subscribe<SceneTruth>("truth", 10, [&](const SceneTruth::ConstPtr&) { ++early; });
    ASSERT_TRUE(spinUntil([&] { return truth_only.getNumPublishers() > 0; }, 30)) << "the nodelet did not load";
    spinUntil([] { return false; }, 1);
    EXPECT_EQ(early, 0) << "nothing happens before both images have subscribers";
  }

  Recorder recorder(nh);
  ASSERT_TRUE(spinUntil([&] { return !recorder.truths.empty() && recorder.truths.back()->last; }, 60)) << "no end of the script";
  spinUntil([] { return false; }, 0.3);

  // A busy machine may leave frames out; at least a quarter of the script's 8 s must have come.
  ASSERT_GT(recorder.frames.size(), 40U);
  const std::vector<SceneTruth::ConstPtr>& truths = recorder.truths;
  EXPECT_LT(truths.front()->joints.at(0).q, 0.02) << "the motion started before the first frame";
  double q_max = 0;
  for (const SceneTruth::ConstPtr& truth : truths) {
    EXPECT_EQ(truth->scene, "drawer");
    EXPECT_EQ(truth->header.frame_id, "test_optical");
    q_max = std::max(q_max, truth->joints.at(0).q);
  }
  EXPECT_NEAR(q_max, truths.front()->joints[0].q_max, 0.02);
  for (size_t i = 1; i < truths.size(); ++i) {
    // Stamps are those of the measurement: whole periods of 20 Hz.
    const double periods = (truths[i]->header.stamp - truths[0]->header.stamp).toSec() * 20;
    EXPECT_NEAR(periods, std::round(periods), 1e-4);
    EXPECT_GT(truths[i]->header.stamp, truths[i - 1]->header.stamp);
  }

  for (const Frame& frame : recorder.frames) {
    EXPECT_EQ(frame.left->encoding, "mono8");
    EXPECT_EQ(frame.left->width, 640U);
    EXPECT_EQ(frame.right->height, 480U);
    EXPECT_EQ(frame.left->header.frame_id, "test_optical");
    EXPECT_EQ(frame.right->header.frame_id, "test_optical");
    const bool has_truth = std::any_of(truths.begin(), truths.end(), [&](const SceneTruth::ConstPtr& truth) {
      return truth->header.stamp == frame.left->header.stamp;
    });
    EXPECT_TRUE(has_truth) << frame.left->header.stamp;
    const core::StereoCamera camera = toStereoCamera(*frame.left_info, *frame.right_info, "left", "right");
    EXPECT_DOUBLE_EQ(camera.fx, 690);
    EXPECT_NEAR(camera.baseline, 0.09, 1e-12);
  }

  // The moving front, taken into the world by tf, moves along one line.
  const SceneTruth& some = *truths[truths.size() / 2];
  ASSERT_TRUE(buffer.canTransform("world", "test_optical", some.header.stamp, ros::Duration(1)));
  const Eigen::Isometry3d T_world_optical =
      tf2::transformToEigen(buffer.lookupTransform("world", "test_optical", some.header.stamp));
  EXPECT_EQ(some.camera.header.frame_id, "world");
  EXPECT_TRUE(fromMessage(some.camera.pose).isApprox(T_world_optical, 1e-6));
  const Eigen::Vector3d axis = T_world_optical.linear() * fromMessage(some.joints[0].axis);
  EXPECT_TRUE(axis.isApprox(-Eigen::Vector3d::UnitY(), 1e-6));
}

/// What the camera that is loaded as `name` says when it refuses to start.
std::string refusal(const std::string& name) {
  ros::NodeHandle nh;
  std::string fatal;
  const ros::Subscriber log = nh.subscribe<rosgraph_msgs::Log>("/rosout", 100, [&](const rosgraph_msgs::Log::ConstPtr& line) {
    if (line->level == rosgraph_msgs::Log::FATAL && line->msg.find(name) != std::string::npos) fatal += line->msg;
  });
  EXPECT_TRUE(ros::service::waitForService("manager/load_nodelet", ros::Duration(30)));
  EXPECT_TRUE(spinUntil([&] { return log.getNumPublishers() > 1; }, 30));
  nodelet::NodeletLoad load;
  load.request.name = name;
  load.request.type = "cabinet_articulation/simulated_stereo_camera";
  EXPECT_TRUE(ros::service::call("manager/load_nodelet", load));
  EXPECT_TRUE(spinUntil([&] { return !fatal.empty(); }, 10));
  return fatal;
}

TEST(SimulatedStereoCamera, RefusesBadParametersInWordsAndStaysSilent) {
  ros::param::set("/broken/camera/scene", "bathroom");
  const std::string fatal = refusal("/broken/camera");
  for (const char* part : {"/broken/camera", "'scene'", "'bathroom'", "'kitchen'"})
    EXPECT_NE(fatal.find(part), std::string::npos) << part << " is missing in: " << fatal;
  ros::master::V_TopicInfo topics;
  ASSERT_TRUE(ros::master::getTopics(topics));
  for (const ros::master::TopicInfo& topic : topics) EXPECT_NE(topic.name, "/broken/truth");
}

TEST(SimulatedStereoCamera, IsNoClockWhereTimeIsReal) {
  ros::param::set("/paced/camera/pace", "results");
  const std::string fatal = refusal("/paced/camera");
  EXPECT_NE(fatal.find("/use_sim_time"), std::string::npos) << fatal;
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "simulated_stereo_camera_rostest");
  return RUN_ALL_TESTS();
}
