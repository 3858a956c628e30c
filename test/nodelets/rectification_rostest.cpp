// SPDX-License-Identifier: BSD-3-Clause
// What image_proc makes of raw images on a robot, and what process_bag makes of them: the same bytes.
#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "cabinet_articulation/ros/image_conversions.h"
#include "support/ros_messages.h"
#include "support/ros_probe.h"
#include "tools/rectifier.h"

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

  void expectTheSameBytes(const sensor_msgs::ImageConstPtr& raw, const sensor_msgs::CameraInfo& info) {
    rectified_.messages.clear();
    ASSERT_TRUE(spinUntil([&] {
      raw_.publish(raw);
      info_.publish(info);
      return spinUntil([&] { return !rectified_.messages.empty(); }, 0.3);
    }));
    const cv::Mat live = toMono(rectified_.messages[0], "image_rect")->image;
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
};

TEST_F(Rectification, IsThatOfImageProcForEveryDistortion) {
  for (const std::string encoding : {"mono8", "bgr8", "rgb8", "bayer_rggb8"}) {
    SCOPED_TRACE(encoding);
    expectTheSameBytes(picture(encoding), camera("plumb_bob", {-0.3, 0.1, 0.001, -0.001, 0}));
  }
  expectTheSameBytes(picture("mono8"), camera("plumb_bob", {0, 0.1, 0, 0, 0}));
  expectTheSameBytes(picture("mono8"), camera("plumb_bob", {-0.3, 0.1, 0.001, -0.001}));
  expectTheSameBytes(picture("mono8"), camera("rational_polynomial", {-0.3, 0.1, 0.001, -0.001, 0.01, 0.02, 0.03, 0.01}));
  expectTheSameBytes(picture("mono8"), camera("equidistant", {-0.02, 0.01, 0.001, 0.0001}));
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
