// SPDX-License-Identifier: BSD-3-Clause
#include "tools/input/scene_bag.h"

#include <cabinet_articulation/SceneTruth.h>
#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <stereo_msgs/DisparityImage.h>
#include <tf2_msgs/TFMessage.h>
#include <unistd.h>

#include <filesystem>
#include <map>

#include "cabinet_articulation/ros/image_conversions.h"
#include "support/ros_messages.h"

namespace cabinet_articulation {
namespace {

using test::errorOf;

class SceneBag : public testing::Test {
 protected:
  SceneBag() : path_(std::filesystem::temp_directory_path() / ("scene_bag_test_" + std::to_string(::getpid()) + ".bag")) {
    config_.simulation.scene = "door";
    config_.frames = 3;
  }
  ~SceneBag() override { std::filesystem::remove(path_); }

  std::map<std::string, int> topics() const {
    std::map<std::string, int> counts;
    rosbag::Bag bag(path_.string());
    for (const rosbag::MessageInstance& instance : rosbag::View(bag)) ++counts[instance.getTopic()];
    return counts;
  }

  template <class Message>
  std::vector<boost::shared_ptr<Message>> read(const std::string& topic) const {
    std::vector<boost::shared_ptr<Message>> messages;
    rosbag::Bag bag(path_.string());
    for (const rosbag::MessageInstance& instance : rosbag::View(bag, rosbag::TopicQuery(topic)))
      messages.push_back(instance.instantiate<Message>());
    return messages;
  }

  std::filesystem::path path_;
  SceneBagConfig config_;
};

TEST_F(SceneBag, HasTheTopicsOfItsInput) {
  EXPECT_EQ(writeSceneBag(path_.string(), config_), 3);
  const std::map<std::string, int> stereo = {{"/tf", 3},
                                             {"/stereo/truth", 3},
                                             {"/stereo/left/camera_info", 3},
                                             {"/stereo/right/camera_info", 3},
                                             {"/stereo/left/image_raw", 3},
                                             {"/stereo/right/image_raw", 3}};
  EXPECT_EQ(topics(), stereo);
  config_.inputs = {"disparity"};
  config_.camera = "/narrow";
  writeSceneBag(path_.string(), config_);
  const std::map<std::string, int> disparity = {{"/tf", 3},
                                                {"/narrow/truth", 3},
                                                {"/narrow/left/camera_info", 3},
                                                {"/narrow/right/camera_info", 3},
                                                {"/narrow/left/image_rect", 3},
                                                {"/narrow/right/image_rect", 3},
                                                {"/narrow/disparity", 3}};
  EXPECT_EQ(topics(), disparity);
  config_.inputs = {"depth"};
  writeSceneBag(path_.string(), config_);
  const std::map<std::string, int> depth = {
      {"/tf", 3}, {"/narrow/truth", 3}, {"/narrow/depth/camera_info", 3}, {"/narrow/depth/image", 3}};
  EXPECT_EQ(topics(), depth);
}

TEST_F(SceneBag, AllOfAFrameHasItsStamp) {
  config_.inputs = {"stereo", "disparity", "depth"};
  config_.start = ros::Time(50);
  config_.simulation.rate = 10;
  writeSceneBag(path_.string(), config_);
  rosbag::Bag bag(path_.string());
  std::map<ros::Time, int> counts;
  for (const rosbag::MessageInstance& instance : rosbag::View(bag)) ++counts[instance.getTime()];
  const std::map<ros::Time, int> expected = {{ros::Time(50), 11}, {ros::Time(50.1), 11}, {ros::Time(50.2), 11}};
  EXPECT_EQ(counts, expected);
  for (const auto& image : read<sensor_msgs::Image>("/stereo/depth/image")) EXPECT_EQ(expected.count(image->header.stamp), 1u);
}

TEST_F(SceneBag, DisparityAndDepthAgree) {
  config_.frames = 1;
  config_.inputs = {"disparity", "depth"};
  writeSceneBag(path_.string(), config_);
  const auto disparity = read<stereo_msgs::DisparityImage>("/stereo/disparity").at(0);
  const auto depth = toDepth(read<sensor_msgs::Image>("/stereo/depth/image").at(0), "depth");
  const auto matched = cv_bridge::toCvCopy(disparity->image);
  int compared = 0;
  double sum = 0;
  for (int v = 0; v < depth->image.rows; ++v) {
    for (int u = 0; u < depth->image.cols; ++u) {
      const float d = matched->image.at<float>(v, u);
      const float z = depth->image.at<float>(v, u);
      if (d <= 0 || z <= 0) continue;
      ++compared;
      sum += std::abs(disparity->f * disparity->T / z - d);
    }
  }
  EXPECT_GT(compared, 100000);
  EXPECT_LT(sum / compared, 0.5) << "px";
}

TEST_F(SceneBag, TheCameraMoves) {
  config_.simulation.camera_motion = 0.1;
  config_.simulation.rate = 1;
  writeSceneBag(path_.string(), config_);
  const auto transforms = read<tf2_msgs::TFMessage>("/tf");
  const auto truths = read<SceneTruth>("/stereo/truth");
  for (size_t i = 0; i < transforms.size(); ++i) {
    const geometry_msgs::TransformStamped& transform = transforms[i]->transforms.at(0);
    EXPECT_EQ(transform.header.frame_id, "world");
    EXPECT_EQ(transform.child_frame_id, truths[i]->header.frame_id);
    EXPECT_EQ(transform.transform.translation.x, truths[i]->camera.pose.position.x);
  }
  EXPECT_NE(transforms[0]->transforms[0].transform.translation.x, transforms[2]->transforms[0].transform.translation.x);
}

TEST_F(SceneBag, RepeatsItsFramesWithTheirStampsButGrowingRecordTimes) {
  config_.first_frame = 30;
  config_.frames = 2;
  config_.rounds = 2;
  config_.simulation.rate = 10;
  EXPECT_EQ(writeSceneBag(path_.string(), config_), 4);
  rosbag::Bag bag(path_.string());
  std::vector<std::pair<ros::Time, ros::Time>> times;
  for (const rosbag::MessageInstance& instance : rosbag::View(bag, rosbag::TopicQuery("/stereo/truth")))
    times.emplace_back(instance.getTime(), instance.instantiate<SceneTruth>()->header.stamp);
  const ros::Time first(1000), second(1000.1);
  const std::vector<std::pair<ros::Time, ros::Time>> expected = {
      {first, first}, {second, second}, {ros::Time(1000.2), first}, {ros::Time(1000.3), second}};
  EXPECT_EQ(times, expected);
  const auto images = read<sensor_msgs::Image>("/stereo/left/image_raw");
  EXPECT_EQ(*images.at(2), *images.at(0));
  EXPECT_EQ(*images.at(3), *images.at(1));
  for (const auto& truth : read<SceneTruth>("/stereo/truth")) EXPECT_GT(truth->joints.at(0).q, 0.1) << "begins where it is open";
}

TEST_F(SceneBag, SaysWhatIsWrong) {
  config_.inputs = {"points"};
  EXPECT_EQ(errorOf([&] { writeSceneBag(path_.string(), config_); }),
            "unknown input 'points', expected stereo, disparity or depth");
  config_.inputs = {"stereo"};
  config_.first_frame = 1000;
  EXPECT_NE(errorOf([&] { writeSceneBag(path_.string(), config_); }).find("frame 1000 is not of the scene's motion"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(path_));
  config_.first_frame = 0;
  EXPECT_NE(errorOf([&] { writeSceneBag("none/out.bag", config_); }).find("none/out.bag: cannot be written"), std::string::npos);
  config_.simulation.scene = "bathroom";
  EXPECT_NE(errorOf([&] { writeSceneBag(path_.string(), config_); }).find("bathroom"), std::string::npos);
}

}  // namespace
}  // namespace cabinet_articulation
