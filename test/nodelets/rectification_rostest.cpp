// SPDX-License-Identifier: BSD-3-Clause
// What the rectify nodelet makes of raw images on a robot, and what process_bag makes of them: the same bytes.
#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "cabinet_articulation/ros/image_conversions.h"
#include "ros/images/rectifier.h"
#include "support/ros_messages.h"
#include "support/ros_probe.h"

namespace cabinet_articulation {
namespace {

using test::Recorder;
using test::spinUntil;

class Rectification : public testing::Test {
 protected:
  void SetUp() override {
    const auto connected = [&] { return raw_.getNumSubscribers() > 0 && info_.getNumSubscribers() > 0; };
    ASSERT_TRUE(spinUntil([&] { return rectified_.connected() && connected(); }));
  }

  /// A picture with structure everywhere, grey or colour.
  sensor_msgs::ImageConstPtr picture(const std::string& encoding) const {
    std::mt19937 random(1);
    const int channels = sensor_msgs::image_encodings::numChannels(encoding);
    const auto image = boost::make_shared<sensor_msgs::Image>(test::greyImage(320, 240, header_, [](int, int) { return 0; }));
    image->encoding = encoding;
    image->step = static_cast<std::uint32_t>(320 * channels);
    image->data.clear();
    for (int i = 0; i < 320 * 240 * channels; ++i) image->data.push_back(static_cast<std::uint8_t>(random()));
    return image;
  }

  sensor_msgs::CameraInfo camera(const std::string& model, const std::vector<double>& D) const {
    sensor_msgs::CameraInfo info = test::cameraInfo(test::smallCamera(), true, header_);
    info.distortion_model = model;
    info.D = D;
    const double angle = 0.02;
    info.R = {std::cos(angle), 0, std::sin(angle), 0, 1, 0, -std::sin(angle), 0, std::cos(angle)};
    info.P[0] = info.P[5] = 280;
    return info;
  }

  /// What the nodelet makes of the image; null if nothing comes.
  sensor_msgs::ImageConstPtr rectify(const sensor_msgs::ImageConstPtr& raw, const sensor_msgs::CameraInfo& info) {
    info_.publish(info);
    test::spinFor(0.1);
    rectified_.messages.clear();
    spinUntil([&] {
      raw_.publish(raw);
      return spinUntil([&] { return !rectified_.messages.empty(); }, 0.3);
    });
    return rectified_.messages.empty() ? nullptr : rectified_.messages[0];
  }

  void expectTheSameBytes(const sensor_msgs::ImageConstPtr& raw, const sensor_msgs::CameraInfo& info) {
    const sensor_msgs::ImageConstPtr message = rectify(raw, info);
    ASSERT_TRUE(message);
    EXPECT_EQ(message->header.stamp, raw->header.stamp);
    EXPECT_EQ(message->header.frame_id, raw->header.frame_id);
    const cv::Mat live = toMono(message, "image_rect")->image;
    const cv::Mat offline = Rectifier()(toMono(raw, "image_raw")->image, info);
    ASSERT_EQ(live.size(), offline.size());
    EXPECT_EQ(cv::countNonZero(live != offline), 0);
    const bool untouched = cv::countNonZero(offline != toMono(raw, "image_raw")->image) == 0;
    const bool distorted = std::any_of(info.D.begin(), info.D.end(), [](double d) { return d != 0; });
    EXPECT_EQ(untouched, !distorted);
    test::spinFor(0.3);
    header_.stamp += ros::Duration(1);
  }

  std_msgs::Header header_ = test::exampleHeader();
  ros::NodeHandle nh_;
  ros::Publisher raw_ = nh_.advertise<sensor_msgs::Image>("image_raw", 10);
  ros::Publisher info_ = nh_.advertise<sensor_msgs::CameraInfo>("camera_info", 10);
  Recorder<sensor_msgs::Image> rectified_{"image_rect"};
  test::Reports reports_;
};

TEST_F(Rectification, IsThatOfProcessBagForEveryDistortion) {
  for (const std::string encoding : {"mono8", "bgr8", "rgb8", "bayer_rggb8"}) {
    SCOPED_TRACE(encoding);
    expectTheSameBytes(picture(encoding), camera("plumb_bob", {-0.3, 0.1, 0.001, -0.001, 0}));
  }
  expectTheSameBytes(picture("mono8"), camera("plumb_bob", {0, 0.1, 0, 0, 0}));
  expectTheSameBytes(picture("mono8"), camera("plumb_bob", {-0.3, 0.1, 0.001, -0.001}));
  expectTheSameBytes(picture("mono8"), camera("rational_polynomial", {-0.3, 0.1, 0.001, -0.001, 0.01, 0.02, 0.03, 0.01}));
}

TEST_F(Rectification, IsOpenCVs) {
  const sensor_msgs::ImageConstPtr raw = picture("mono8");
  const sensor_msgs::CameraInfo info = camera("plumb_bob", {-0.3, 0.1, 0.001, -0.001, 0});
  const cv::Matx33d K(info.K.data()), R(info.R.data());
  const cv::Matx34d P(info.P.data());
  cv::Mat map_u, map_v, expected;
  cv::initUndistortRectifyMap(K, info.D, R, P, {320, 240}, CV_16SC2, map_u, map_v);
  cv::remap(toMono(raw, "image_raw")->image, expected, map_u, map_v, cv::INTER_LINEAR);
  const sensor_msgs::ImageConstPtr live = rectify(raw, info);
  ASSERT_TRUE(live);
  EXPECT_EQ(cv::countNonZero(toMono(live, "image_rect")->image != expected), 0);
}

TEST_F(Rectification, ACameraInfoThatCannotBeUsedIsSaidAndEndsNothing) {
  const auto said = [&](const sensor_msgs::CameraInfo& info, const std::string& text) {
    return spinUntil([&] {
      info_.publish(info);
      raw_.publish(picture("mono8"));
      return spinUntil([&] { return reports_.statusHas("rectify", text); }, 0.2);
    });
  };
  EXPECT_TRUE(said(camera("mirror_ball", {0.1}), "/camera_info: distortion_model is 'mirror_ball', expected plumb_bob"))
      << reports_.status("rectify");
  EXPECT_TRUE(said(camera("plumb_bob", {0.1, 0}), "/camera_info: CameraInfo describes no lens")) << reports_.status("rectify");
  EXPECT_TRUE(said(camera("equidistant", {0.1, 0, 0, 0, 0}), "/camera_info: ")) << reports_.status("rectify");
  sensor_msgs::CameraInfo small = camera("plumb_bob", {0.1, 0, 0, 0, 0});
  small.width = 160;
  EXPECT_TRUE(said(small, "/image_raw: size is 320x240, expected 160x240 as its CameraInfo says")) << reports_.status("rectify");
  expectTheSameBytes(picture("mono8"), camera("plumb_bob", {-0.3, 0.1, 0.001, -0.001, 0}));
}

TEST_F(Rectification, LeavesImagesWithoutDistortionAlone) {
  expectTheSameBytes(picture("mono8"), camera("plumb_bob", {0, 0, 0, 0, 0}));
  expectTheSameBytes(picture("mono8"), camera("plumb_bob", {}));
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "rectification_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
