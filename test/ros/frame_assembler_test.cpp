// SPDX-License-Identifier: BSD-3-Clause
#include "ros/input/frame_assembler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <random>
#include <vector>

#include "cabinet_articulation/ros/image_conversions.h"
#include "cabinet_articulation/stereo/block_matcher.h"
#include "support/ros_messages.h"

namespace cabinet_articulation {
namespace {

using test::errorOf;
using test::smallCamera;

std_msgs::Header headerAt(double stamp) {
  std_msgs::Header header;
  header.frame_id = "camera";
  header.stamp = ros::Time(stamp);
  return header;
}

sensor_msgs::ImageConstPtr imageAt(double stamp) {
  return boost::make_shared<sensor_msgs::Image>(test::greyImage(320, 240, headerAt(stamp), [](int, int) { return 7; }));
}

sensor_msgs::CameraInfoConstPtr infoAt(double stamp, bool right = false) {
  return boost::make_shared<sensor_msgs::CameraInfo>(test::cameraInfo(smallCamera(), right, headerAt(stamp)));
}

stereo_msgs::DisparityImageConstPtr disparityAt(double stamp) {
  return boost::make_shared<stereo_msgs::DisparityImage>(
      test::disparityImage(smallCamera(), headerAt(stamp), [](int, int) { return 10.F; }));
}

sensor_msgs::ImageConstPtr depthAt(double stamp) {
  return boost::make_shared<sensor_msgs::Image>(
      test::disparityImage(smallCamera(), headerAt(stamp), [](int, int) { return 2.F; }).image);
}

class Assembler : public testing::Test {
 protected:
  FrameAssembler make(const std::string& input, const SyncConfig& sync = {}) {
    FrameInputConfig config;
    config.input = input;
    return FrameAssembler(
        config, sync, FrameTopics::below("/stereo/", input), [this](const FrameMessages& frame) { frames_.push_back(frame); },
        [this](const std::string& why) { left_out_.push_back(why); });
  }

  std::vector<FrameMessages> frames_;
  std::vector<std::string> left_out_;
};

TEST_F(Assembler, DepthIsCompleteWithItsCamera) {
  FrameAssembler assembler = make("depth");
  assembler.addDepth(depthAt(1));
  const auto depth = depthAt(2);
  assembler.addDepth(depth);
  EXPECT_TRUE(frames_.empty()) << "nobody knows the camera";
  assembler.addInfo(infoAt(2));
  ASSERT_EQ(frames_.size(), 1u) << "its camera came late";
  EXPECT_EQ(frames_[0].depth, depth);
  EXPECT_EQ(frames_[0].header().stamp, ros::Time(2));
  const FrameViews views = assembler.view(frames_[0]);
  EXPECT_EQ(views.frame.camera.baseline, FrameInputConfig().virtual_baseline);
  EXPECT_FLOAT_EQ(views.frame.disparity(3, 4), static_cast<float>(300 * 0.075 / 2));
}

TEST_F(Assembler, TakesTheCameraInfoOfTheFramesStampElseTheNewest) {
  FrameAssembler assembler = make("depth");
  const auto own = infoAt(1), newest = infoAt(2);
  assembler.addInfo(own);
  assembler.addInfo(newest);
  assembler.addDepth(depthAt(1));
  assembler.addDepth(depthAt(1.5));
  ASSERT_EQ(frames_.size(), 2u);
  EXPECT_EQ(frames_[0].info, own);
  EXPECT_EQ(frames_[1].info, newest);
}

TEST_F(Assembler, TheFirstDisparityHasTheCamerasThatAreExpected) {
  FrameAssembler assembler = make("disparity");
  assembler.expectRightInfo();
  const auto left = infoAt(1), right = infoAt(1, true);
  assembler.addDisparity(disparityAt(1));
  assembler.addInfo(left);
  EXPECT_TRUE(frames_.empty());
  assembler.addRightInfo(right);
  ASSERT_EQ(frames_.size(), 1u);
  EXPECT_EQ(frames_[0].info, left);
  EXPECT_EQ(frames_[0].right_info, right);
  assembler.addDisparity(disparityAt(2));
  EXPECT_EQ(frames_.size(), 2u) << "cameras hardly change";
}

TEST_F(Assembler, ADisparityWithoutAnyImagesDoesNotWait) {
  FrameAssembler assembler = make("disparity");
  assembler.addInfo(infoAt(1));
  assembler.addDisparity(disparityAt(1));
  assembler.addLeft(imageAt(2));
  assembler.addDisparity(disparityAt(2));
  ASSERT_EQ(frames_.size(), 2u) << "one image alone is of no use";
  EXPECT_FALSE(frames_[1].left);
}

TEST_F(Assembler, ImagesAndDisparityComeInWhateverOrder) {
  FrameAssembler assembler = make("disparity");
  assembler.expectImages();
  assembler.addInfo(infoAt(1));
  const auto left = imageAt(1), right = imageAt(1), later_right = imageAt(2);
  assembler.addDisparity(disparityAt(1));
  assembler.addRight(right);
  EXPECT_TRUE(frames_.empty());
  EXPECT_FALSE(assembler.find(ros::Time(1))) << "it is not complete";
  assembler.addLeft(left);
  ASSERT_EQ(frames_.size(), 1u);
  EXPECT_EQ(frames_[0].left, left);
  EXPECT_EQ(frames_[0].right, right);
  assembler.addLeft(imageAt(2));
  assembler.addRight(later_right);
  assembler.addDisparity(disparityAt(2));
  ASSERT_EQ(frames_.size(), 2u);
  EXPECT_EQ(frames_[1].right, later_right);
}

TEST_F(Assembler, ADisparityWaitsAtMostUntilTheNextOrTheEnd) {
  FrameAssembler assembler = make("disparity");
  assembler.expectImages();
  assembler.addInfo(infoAt(1));
  assembler.addDisparity(disparityAt(1));
  EXPECT_TRUE(frames_.empty());
  assembler.addDisparity(disparityAt(2));
  ASSERT_EQ(frames_.size(), 1u);
  EXPECT_FALSE(frames_[0].left);
  assembler.flush();
  ASSERT_EQ(frames_.size(), 2u);
  assembler.flush();
  EXPECT_EQ(frames_.size(), 2u);
}

TEST_F(Assembler, SaysWhichFramesItLeavesOutForWantOfACamera) {
  FrameAssembler depth = make("depth"), disparity = make("disparity");
  depth.addDepth(depthAt(1));
  disparity.addDisparity(disparityAt(1));
  disparity.addRightInfo(infoAt(1, true));
  disparity.addDisparity(disparityAt(2));
  disparity.flush();
  depth.flush();
  EXPECT_TRUE(frames_.empty());
  const std::string of_disparity =
      "/stereo/left/camera_info: no CameraInfo yet; until the first one, /stereo/disparity is not used";
  std::sort(left_out_.begin(), left_out_.end());
  EXPECT_EQ(left_out_, (std::vector<std::string>{
                           "/stereo/depth/camera_info: no CameraInfo yet; until the first one, /stereo/depth/image is not used",
                           of_disparity, of_disparity}));
  disparity.addInfo(infoAt(3));
  disparity.addDisparity(disparityAt(3));
  EXPECT_EQ(frames_.size(), 1u);
  EXPECT_EQ(left_out_.size(), 3u);
}

TEST_F(Assembler, StampsThatComeAgainBringNoImagesOfBefore) {
  // A short bag in a loop, each disparity before its images. In the first round the disparity of the first frame is lost.
  FrameAssembler assembler = make("disparity");
  assembler.expectImages();
  assembler.addInfo(infoAt(1));
  for (int round = 0; round < 3; ++round)
    for (int i = 1; i <= 4; ++i) {
      const bool lost = round == 0 && i == 1;
      if (!lost) assembler.addDisparity(disparityAt(i));
      const auto left = imageAt(i), right = imageAt(i);
      frames_.clear();
      assembler.addLeft(left);
      assembler.addRight(right);
      ASSERT_EQ(frames_.size(), lost ? 0u : 1u) << "round " << round << ", frame " << i;
      if (lost) continue;
      EXPECT_EQ(frames_[0].left, left);
      EXPECT_EQ(frames_[0].right, right);
    }
}

TEST_F(Assembler, FramesOfUntriggeredCamerasHaveThePairOfTheirLeftImage) {
  SyncConfig sync;
  sync.approximate_sync = true;
  FrameAssembler assembler = make("disparity", sync);
  assembler.addInfo(infoAt(1));
  const auto right = imageAt(1.004);
  assembler.addLeft(imageAt(1));
  assembler.addRight(right);
  assembler.addDisparity(disparityAt(1));
  ASSERT_EQ(frames_.size(), 1u);
  EXPECT_EQ(frames_[0].right, right);
}

TEST_F(Assembler, CompleteFramesAreFoundUntilManyOthersCame) {
  FrameAssembler assembler = make("depth");
  assembler.addInfo(infoAt(1));
  for (int i = 1; i <= 10; ++i) assembler.addDepth(depthAt(i));
  ASSERT_TRUE(assembler.find(ros::Time(1)));
  EXPECT_EQ(assembler.find(ros::Time(1))->depth, frames_[0].depth);
  const auto again = depthAt(1);
  assembler.addDepth(again);
  EXPECT_EQ(assembler.find(ros::Time(1))->depth, again) << "time was set back";
  for (int i = 11; i <= 1000; ++i) assembler.addDepth(depthAt(i));
  EXPECT_FALSE(assembler.find(ros::Time(1)));
  assembler.clear();
  EXPECT_FALSE(assembler.find(ros::Time(1000)));
}

TEST_F(Assembler, TroublesNameTheirTopic) {
  FrameAssembler depth = make("depth"), disparity = make("disparity");
  FrameMessages frame;
  frame.info = infoAt(1);
  const auto small = boost::make_shared<sensor_msgs::Image>(test::greyImage(8, 4, headerAt(1), [](int, int) { return 7; }));
  frame.depth = small;
  EXPECT_EQ(errorOf([&] { depth.view(frame); }), "/stereo/depth/image: encoding is 'mono8', expected 16UC1 or 32FC1");
  const auto small_depth = boost::make_shared<sensor_msgs::Image>(*small);
  small_depth->encoding = "16UC1";
  small_depth->width = 4;
  frame.depth = small_depth;
  EXPECT_EQ(errorOf([&] { depth.view(frame); }).find("/stereo/depth/image: the depth image is 4x4"), 0u);
  frame.depth.reset();
  frame.disparity = disparityAt(1);
  frame.left = imageAt(1);
  frame.right = small;
  EXPECT_EQ(errorOf([&] { disparity.view(frame); }),
            "/stereo/right/image_rect: size is 8x4, expected 320x240 as its CameraInfo says");
}

bool sameBytes(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  for (int v = 0; v < a.rows; ++v)
    if (std::memcmp(a.ptr(v), b.ptr(v), a.cols * a.elemSize()) != 0) return false;
  return true;
}

/// A pair with texture, block matching as in the nodelet, and everything through messages: the planes must be found in exactly
/// what the matcher found.
TEST_F(Assembler, WhatTheBlockMatcherFoundArrivesBitForBit) {
  core::StereoCamera camera{320, 240, 300.1234567890123, 301.2345678901234, 155.3456789, 118.4567, 0.0812345678901, 0};
  for (const double cx_difference : {0.0, 1.2345678, -20.5})
    for (const int min_disparity : {0, 16, -16}) {
      SCOPED_TRACE("cx_difference " + std::to_string(cx_difference) + ", min_disparity " + std::to_string(min_disparity));
      camera.cx_difference = cx_difference;
      const auto left_info = boost::make_shared<sensor_msgs::CameraInfo>(test::cameraInfo(camera, false, headerAt(1)));
      const auto right_info = boost::make_shared<sensor_msgs::CameraInfo>(test::cameraInfo(camera, true, headerAt(1)));
      std::mt19937 random(1);
      cv::Mat1b texture(240, 400);
      for (std::uint8_t& grey : texture) grey = static_cast<std::uint8_t>(random());
      const cv::Mat1b left = texture(cv::Rect(0, 0, 320, 240)).clone(), right = texture(cv::Rect(21, 0, 320, 240)).clone();
      core::StereoConfig config;
      config.disparity_range = 64;
      config.min_disparity = min_disparity;
      const core::DepthFrame sent =
          core::BlockMatcher(config).process(left, right, toStereoCamera(*left_info, *right_info, "l", "r"));
      ASSERT_GT(cv::countNonZero(sent.disparity), 10000) << "or this test shows nothing";

      FrameAssembler assembler = make("disparity");
      assembler.addInfo(left_info);
      assembler.addRightInfo(right_info);
      assembler.addLeft(boost::make_shared<sensor_msgs::Image>(toMessage(left, headerAt(1))));
      assembler.addRight(boost::make_shared<sensor_msgs::Image>(toMessage(right, headerAt(1))));
      frames_.clear();
      assembler.addDisparity(boost::make_shared<stereo_msgs::DisparityImage>(
          toMessage(sent, headerAt(1), config.min_disparity, config.disparity_range)));
      ASSERT_EQ(frames_.size(), 1u);
      const FrameViews views = assembler.view(frames_[0]);
      const core::DepthFrame& got = views.frame;
      EXPECT_TRUE(sameBytes(got.disparity, sent.disparity));
      EXPECT_TRUE(sameBytes(got.left, left));
      EXPECT_TRUE(sameBytes(got.right, right));
      EXPECT_EQ(got.camera.width, sent.camera.width);
      EXPECT_EQ(got.camera.height, sent.camera.height);
      EXPECT_EQ(got.camera.fx, sent.camera.fx);
      EXPECT_EQ(got.camera.fy, sent.camera.fy);
      EXPECT_EQ(got.camera.cx, sent.camera.cx);
      EXPECT_EQ(got.camera.cy, sent.camera.cy);
      EXPECT_EQ(got.camera.baseline, sent.camera.baseline);
      EXPECT_EQ(got.camera.cx_difference, sent.camera.cx_difference);
    }
}

}  // namespace
}  // namespace cabinet_articulation
