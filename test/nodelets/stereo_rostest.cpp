// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "support/ros_messages.h"
#include "support/ros_probe.h"

namespace cabinet_articulation {
namespace {

using test::Recorder;
using test::spinUntil;

constexpr int kDisparity = 12;

/// A camera pair that looks at a flat random texture.
class StereoNodelet : public testing::Test {
 protected:
  StereoNodelet() : texture_(static_cast<size_t>((camera_.width + kDisparity) * camera_.height)) {
    std::mt19937 random(1);
    for (std::uint8_t& grey : texture_) grey = static_cast<std::uint8_t>(random() & 0xFF);
  }

  void SetUp() override {
    ASSERT_TRUE(spinUntil([&] { return disparities_.connected() && connected(left_) && connected(right_info_); }));
  }

  static bool connected(const ros::Publisher& publisher) { return publisher.getNumSubscribers() > 0; }

  std_msgs::Header header() {
    std_msgs::Header header;
    header.frame_id = "optical";
    header.stamp = stamp_ += ros::Duration(0.1);
    return header;
  }

  sensor_msgs::Image image(bool right, const std_msgs::Header& header) const {
    const int offset = right ? kDisparity : 0;
    return test::greyImage(camera_.width, camera_.height, header, [&](int u, int v) {
      return texture_[static_cast<size_t>(v * (camera_.width + kDisparity) + u + offset)];
    });
  }

  void publishInfos(const std_msgs::Header& header) {
    left_info_.publish(test::cameraInfo(camera_, false, header));
    right_info_.publish(test::cameraInfo(camera_, true, header));
  }

  std_msgs::Header publishGoodFrame() {
    const std_msgs::Header h = header();
    publishInfos(h);
    left_.publish(image(false, h));
    right_.publish(image(true, h));
    return h;
  }

  /// Publishes until a disparity comes; frames before the camera infos have arrived give none.
  bool goodInputWorks() {
    const size_t before = disparities_.messages.size();
    return spinUntil([&] {
      publishGoodFrame();
      return spinUntil([&] { return disparities_.messages.size() > before; }, 0.2);
    });
  }

  /// Repeats `publish` until /diagnostics says `text`.
  bool diagnosed(const std::function<void()>& publish, const std::string& text) {
    return spinUntil([&] {
      publish();
      return spinUntil([&] { return reports_.statusHas("stereo", text); }, 0.1);
    });
  }

  const core::StereoCamera camera_ = test::smallCamera();
  std::vector<std::uint8_t> texture_;
  ros::Time stamp_ = ros::Time::now();
  ros::NodeHandle nh_;
  ros::Publisher left_ = nh_.advertise<sensor_msgs::Image>("left/image_rect", 10);
  ros::Publisher right_ = nh_.advertise<sensor_msgs::Image>("right/image_rect", 10);
  ros::Publisher left_info_ = nh_.advertise<sensor_msgs::CameraInfo>("left/camera_info", 10);
  ros::Publisher right_info_ = nh_.advertise<sensor_msgs::CameraInfo>("right/camera_info", 10);
  Recorder<stereo_msgs::DisparityImage> disparities_{"disparity"};
  test::Reports reports_;
};

TEST_F(StereoNodelet, MeasuresTheShiftBetweenTheImages) {
  ASSERT_TRUE(goodInputWorks());
  const stereo_msgs::DisparityImage& message = *disparities_.messages.back();
  EXPECT_EQ(message.header.frame_id, "optical");
  EXPECT_EQ(message.f, camera_.fx);
  EXPECT_FLOAT_EQ(message.T, static_cast<float>(camera_.baseline));
  ASSERT_EQ(message.image.width, static_cast<unsigned>(camera_.width));
  ASSERT_EQ(message.image.height, static_cast<unsigned>(camera_.height));
  const float* disparity = reinterpret_cast<const float*>(message.image.data.data());
  const long right = std::count_if(disparity, disparity + camera_.width * camera_.height,
                                   [](float d) { return std::abs(d - kDisparity) < 0.2F; });
  // The texture matches everywhere but in the margin of half a window (7 px) and beyond the right image's edge.
  EXPECT_GT(right, 0.85 * camera_.width * camera_.height);
}

TEST_F(StereoNodelet, AnswersWithTheStampOfItsInput) {
  ASSERT_TRUE(goodInputWorks());
  test::spinFor(0.3);
  disparities_.messages.clear();
  const std_msgs::Header sent = publishGoodFrame();
  ASSERT_TRUE(spinUntil([&] { return !disparities_.messages.empty(); }));
  EXPECT_EQ(disparities_.messages[0]->header.stamp, sent.stamp);
}

TEST_F(StereoNodelet, ConvertsColourImages) {
  ASSERT_TRUE(goodInputWorks());
  test::spinFor(0.3);
  disparities_.messages.clear();
  const std_msgs::Header h = header();
  for (const bool right : {false, true}) {
    sensor_msgs::Image colour = image(right, h);
    std::vector<std::uint8_t> grey;
    grey.swap(colour.data);
    for (const std::uint8_t value : grey) colour.data.insert(colour.data.end(), 3, value);
    colour.encoding = "bgr8";
    colour.step *= 3;
    (right ? right_ : left_).publish(colour);
  }
  ASSERT_TRUE(spinUntil([&] { return !disparities_.messages.empty(); }));
  const auto& data = disparities_.messages[0]->image.data;
  EXPECT_NEAR(reinterpret_cast<const float*>(data.data())[120 * camera_.width + 160], kDisparity, 0.2);
}

TEST_F(StereoNodelet, NamesImagesOfDifferentSize) {
  const auto publish = [&] {
    const std_msgs::Header h = header();
    publishInfos(h);
    left_.publish(image(false, h));
    right_.publish(test::greyImage(160, 120, h, [](int, int) { return 0; }));
  };
  EXPECT_TRUE(diagnosed(publish, "/right/image_rect: size is 160x120, expected 320x240 as its CameraInfo says"))
      << reports_.status("stereo");
  EXPECT_TRUE(reports_.logged(rosgraph_msgs::Log::WARN, "/right/image_rect: size is 160x120"));
  EXPECT_TRUE(goodInputWorks());
}

TEST_F(StereoNodelet, TellsByHowMuchStampsDiffer) {
  const auto publish = [&] {
    std_msgs::Header h = header();
    publishInfos(h);
    left_.publish(image(false, h));
    h.stamp += ros::Duration(0.033);
    right_.publish(image(true, h));
  };
  EXPECT_TRUE(diagnosed(publish, "left and right stamps differ by 33 ms")) << reports_.status("stereo");
  EXPECT_TRUE(reports_.logged(rosgraph_msgs::Log::WARN, "left and right stamps differ by 33 ms"));
  EXPECT_TRUE(goodInputWorks());
}

TEST_F(StereoNodelet, NamesAMissingBaseline) {
  const auto publish = [&] {
    const std_msgs::Header h = header();
    left_info_.publish(test::cameraInfo(camera_, false, h));
    right_info_.publish(test::cameraInfo(camera_, false, h));
    left_.publish(image(false, h));
    right_.publish(image(true, h));
  };
  EXPECT_TRUE(diagnosed(publish, "/right/camera_info: right P[3] is 0, expected -fx * baseline")) << reports_.status("stereo");
  EXPECT_TRUE(goodInputWorks());
}

TEST_F(StereoNodelet, NamesAZeroFocalLength) {
  const auto publish = [&] {
    const std_msgs::Header h = header();
    sensor_msgs::CameraInfo uncalibrated = test::cameraInfo(camera_, false, h);
    uncalibrated.P.assign(0);
    left_info_.publish(uncalibrated);
    right_info_.publish(test::cameraInfo(camera_, true, h));
    left_.publish(image(false, h));
    right_.publish(image(true, h));
  };
  EXPECT_TRUE(diagnosed(publish, "/left/camera_info: left P[0] is 0, expected a positive focal length"))
      << reports_.status("stereo");
  EXPECT_TRUE(goodInputWorks());
}

TEST_F(StereoNodelet, SaysThatThePairIsSwapped) {
  const auto publish = [&] {
    const std_msgs::Header h = header();
    publishInfos(h);
    left_.publish(image(true, h));
    right_.publish(image(false, h));
  };
  EXPECT_TRUE(diagnosed(publish, "/left/image_rect and /right/image_rect match only the other way round: are they swapped?"))
      << reports_.status("stereo");
  EXPECT_TRUE(goodInputWorks());
}

TEST_F(StereoNodelet, LeavesOutTheFramesOfAnEmitterThatAlternates) {
  ASSERT_TRUE(goodInputWorks());
  std::vector<ros::Time> unlit;
  const auto publish = [&] {
    publishGoodFrame();
    test::spinFor(0.05);  // the stage takes the newest frame
    const std_msgs::Header h = header();
    unlit.push_back(h.stamp);
    publishInfos(h);
    for (ros::Publisher* side : {&left_, &right_}) side->publish(test::greyImage(320, 240, h, [](int, int) { return 60; }));
  };
  EXPECT_TRUE(diagnosed(publish, "/left/image_rect: the projector's pattern comes and goes from frame to frame"))
      << reports_.status("stereo");
  test::spinFor(0.3);
  disparities_.messages.clear();
  unlit.clear();
  for (int i = 0; i < 10; ++i) {
    publish();
    test::spinFor(0.1);
  }
  EXPECT_FALSE(disparities_.messages.empty());
  for (const auto& message : disparities_.messages) EXPECT_EQ(std::count(unlit.begin(), unlit.end(), message->header.stamp), 0);
  EXPECT_GE(std::atoi(reports_.value("stereo", "frames without the projector's pattern").c_str()), 10);
  EXPECT_TRUE(goodInputWorks());
}

TEST_F(StereoNodelet, NamesTheTopicThatIsMissing) {
  const auto publish = [&] {
    const std_msgs::Header h = header();
    publishInfos(h);
    left_.publish(image(false, h));
  };
  EXPECT_TRUE(diagnosed(publish, "/right/image_rect: nothing received for 4 s, although 1 publisher offers it"))
      << reports_.status("stereo");
  EXPECT_FALSE(reports_.statusHas("stereo", "/left/image_rect: nothing received"));
  EXPECT_TRUE(goodInputWorks());
  right_.shutdown();
  EXPECT_TRUE(diagnosed(publish, "/right/image_rect: nothing received for 4 s, nobody publishes it"))
      << reports_.status("stereo");
}

TEST(LazyStereoNodelet, SubscribesOnlyWhileSomebodyListens) {
  ros::NodeHandle nh;
  const ros::Publisher left = nh.advertise<sensor_msgs::Image>("left/image_rect", 10);
  test::Reports reports;
  ASSERT_TRUE(spinUntil([&] { return reports.statusHas("stereo", "idle: nobody subscribes to its results"); }));
  EXPECT_EQ(left.getNumSubscribers(), 0u);
  {
    const Recorder<stereo_msgs::DisparityImage> listener("disparity");
    EXPECT_TRUE(spinUntil([&] { return left.getNumSubscribers() == 1; }));
  }
  EXPECT_TRUE(spinUntil([&] { return left.getNumSubscribers() == 0; }));
}

TEST(LazyStereoNodelet, SaysWhichCameraInfoIsMissing) {
  ros::NodeHandle nh;
  ros::Publisher left = nh.advertise<sensor_msgs::Image>("left/image_rect", 10);
  ros::Publisher right = nh.advertise<sensor_msgs::Image>("right/image_rect", 10);
  ros::Publisher right_info = nh.advertise<sensor_msgs::CameraInfo>("right/camera_info", 10);
  test::Reports reports;
  ASSERT_TRUE(spinUntil([&] { return reports.statusHas("stereo", "idle: nobody subscribes to its results"); }))
      << "then it knows no camera any more";
  const Recorder<stereo_msgs::DisparityImage> disparities("disparity");
  std_msgs::Header header;
  header.stamp = ros::Time::now();
  EXPECT_TRUE(spinUntil([&] {
    header.stamp += ros::Duration(0.1);
    right_info.publish(test::cameraInfo(test::smallCamera(), true, header));
    for (ros::Publisher* side : {&left, &right}) side->publish(test::greyImage(320, 240, header, [](int, int) { return 7; }));
    return spinUntil(
        [&] {
          return reports.statusHas("stereo",
                                   "/left/camera_info: no CameraInfo yet; until the first one, /left/image_rect and "
                                   "/right/image_rect are not used");
        },
        0.1);
  })) << reports.status("stereo");
  EXPECT_TRUE(disparities.messages.empty());
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "stereo_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
