// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/ros/image_conversions.h"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <cmath>
#include <limits>

#include "support/ros_messages.h"

namespace cabinet_articulation {
namespace {

using test::cameraInfo;
using test::disparityImage;
using test::errorOf;
using test::exampleHeader;
using test::greyImage;
using test::smallCamera;

const float kNan = std::numeric_limits<float>::quiet_NaN();
const float kInf = std::numeric_limits<float>::infinity();

std::string pairError(const sensor_msgs::CameraInfo& left, const sensor_msgs::CameraInfo& right) {
  return errorOf([&] { toStereoCamera(left, right, "/stereo/left/camera_info", "/stereo/right/camera_info"); });
}

TEST(CameraConversion, TakesThePairFromItsProjectionMatrices) {
  core::StereoCamera camera = smallCamera();
  camera.cx_difference = 4;
  const core::StereoCamera back = toStereoCamera(cameraInfo(camera, false), cameraInfo(camera, true), "l", "r");
  EXPECT_EQ(back.width, 320);
  EXPECT_EQ(back.height, 240);
  EXPECT_EQ(back.fx, camera.fx);
  EXPECT_EQ(back.cx, camera.cx);
  EXPECT_EQ(back.cy, camera.cy);
  EXPECT_NEAR(back.baseline, camera.baseline, 1e-15);
  EXPECT_EQ(back.cx_difference, 4);
}

TEST(CameraConversion, NamesTopicAndElementOfABadCalibration) {
  const sensor_msgs::CameraInfo left = cameraInfo(smallCamera(), false);
  sensor_msgs::CameraInfo right = cameraInfo(smallCamera(), true);
  right.P[3] = 0;
  EXPECT_EQ(pairError(left, right).find("/stereo/right/camera_info: right P[3] is 0, expected -fx * baseline"), 0u);
  sensor_msgs::CameraInfo uncalibrated;
  uncalibrated.width = left.width;
  uncalibrated.height = left.height;
  EXPECT_EQ(pairError(uncalibrated, right).find("/stereo/left/camera_info: left P[0] is 0, expected a positive focal length"),
            0u);
  right = cameraInfo(smallCamera(), true);
  right.width = 640;
  EXPECT_EQ(pairError(left, right),
            "/stereo/right/camera_info: size is 640x240, expected that of /stereo/left/camera_info, 320x240");
}

/// A CameraInfo of the full sensor, of which a region is read with every second pixel.
sensor_msgs::CameraInfo croppedAndBinned(sensor_msgs::CameraInfo info) {
  info.binning_x = 2;
  info.binning_y = 4;
  info.roi.x_offset = 40;
  info.roi.y_offset = 20;
  info.roi.width = 160;
  info.roi.height = 120;
  return info;
}

TEST(CameraConversion, RegionOfInterestAndBinningChangeTheCamera) {
  core::StereoCamera full = smallCamera();
  full.cx_difference = 4;
  const sensor_msgs::CameraInfo left = croppedAndBinned(cameraInfo(full, false)),
                                right = croppedAndBinned(cameraInfo(full, true));
  const core::StereoCamera pair = toStereoCamera(left, right, "l", "r");
  EXPECT_EQ(cv::Size(pair.width, pair.height), cv::Size(80, 30));
  EXPECT_EQ(pair.fx, full.fx / 2);
  EXPECT_EQ(pair.fy, full.fy / 4);
  EXPECT_EQ(pair.cx, (full.cx - 40) / 2);
  EXPECT_EQ(pair.cy, (full.cy - 20) / 4);
  EXPECT_NEAR(pair.baseline, full.baseline, 1e-15);
  EXPECT_EQ(pair.cx_difference, 2);

  const core::StereoCamera depth = toDepthCamera(left, "t", 0.075);
  EXPECT_EQ(cv::Size(depth.width, depth.height), cv::Size(80, 30));
  EXPECT_EQ(depth.fx, pair.fx);
  EXPECT_EQ(depth.cy, pair.cy);

  core::StereoCamera seen = pair;
  seen.cx_difference = 0;
  const auto disparity = disparityImage(seen, exampleHeader(), [](int, int) { return 1.F; });
  const core::StereoCamera camera = toDisparityCamera(disparity, "d", left, "l", &right);
  EXPECT_EQ(cv::Size(camera.width, camera.height), cv::Size(80, 30));
  EXPECT_NEAR(camera.focalBaseline(), pair.focalBaseline(), 1e-5);
  EXPECT_EQ(camera.cx, pair.cx);
}

TEST(CameraConversion, SwappedCalibrationsAreSaid) {
  const sensor_msgs::CameraInfo left = cameraInfo(smallCamera(), false), right = cameraInfo(smallCamera(), true);
  EXPECT_NE(pairError(right, left).find("left and right are swapped"), std::string::npos) << pairError(right, left);
}

TEST(CameraConversion, DepthCameraUsesPAndElseK) {
  sensor_msgs::CameraInfo info = cameraInfo(smallCamera(), false);
  info.P[0] = 290;
  EXPECT_EQ(toDepthCamera(info, "t", 0.075).fx, 290);
  info.P.assign(0);
  EXPECT_EQ(toDepthCamera(info, "t", 0.075).fx, 300);
  info.K.assign(0);
  EXPECT_EQ(errorOf([&] { toDepthCamera(info, "/depth/camera_info", 0.075); }).find("/depth/camera_info: K[0] is 0, expected"),
            0u);
}

TEST(CameraConversion, DisparityCameraTrustsTheMessagesFocalLengthTimesBaseline) {
  auto disparity = disparityImage(smallCamera(), exampleHeader(), [](int, int) { return 10.F; });
  const sensor_msgs::CameraInfo left = cameraInfo(smallCamera(), false);
  sensor_msgs::CameraInfo right = cameraInfo(smallCamera(), true);
  right.P[2] -= 3;
  const core::StereoCamera camera = toDisparityCamera(disparity, "d", left, "l", &right);
  EXPECT_NEAR(camera.focalBaseline(), 300 * 0.08, 1e-6);
  EXPECT_EQ(camera.cx, 155);
  EXPECT_EQ(camera.cx_difference, 3);
  EXPECT_EQ(toDisparityCamera(disparity, "d", left, "l").cx_difference, 0);
  disparity.T = 0;
  EXPECT_EQ(errorOf([&] { toDisparityCamera(disparity, "/d", left, "l"); }), "/d: baseline T is 0, expected 0.001 to 10 m");
  disparity.T = 0.08F;
  disparity.f = kNan;
  EXPECT_EQ(errorOf([&] { toDisparityCamera(disparity, "/d", left, "l"); }),
            "/d: focal length f is nan, expected 1 to 100000 px");
  disparity.f = 300;
  EXPECT_EQ(errorOf([&] { toDisparityCamera(disparity, "/d", sensor_msgs::CameraInfo(), "/l"); }).find("/l: "), 0u);
}

/// A camera whose numbers no float holds.
core::StereoCamera unevenCamera() {
  return {320, 240, 300.1234567890123, 301.2345678901234, 155.3456789, 118.4567, 0.0812345678901, 1.234567};
}

bool same(const core::StereoCamera& a, const core::StereoCamera& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy &&
         a.baseline == b.baseline && a.cx_difference == b.cx_difference;
}

TEST(CameraConversion, DisparityCameraIsTheStereoCameraThatTheMessageWasComputedWith) {
  const sensor_msgs::CameraInfo left = cameraInfo(unevenCamera(), false), right = cameraInfo(unevenCamera(), true);
  const core::StereoCamera expected = toStereoCamera(left, right, "l", "r");
  auto disparity = disparityImage(expected, exampleHeader(), [](int, int) { return 10.F; });
  EXPECT_TRUE(same(toDisparityCamera(disparity, "d", left, "l", &right), expected));
  EXPECT_FALSE(same(toDisparityCamera(disparity, "d", left, "l"), expected)) << "or this test shows nothing";

  disparity.T = std::nextafter(disparity.T, 1.F);
  const core::StereoCamera other = toDisparityCamera(disparity, "d", left, "l", &right);
  EXPECT_NEAR(other.focalBaseline(), static_cast<double>(disparity.f) * disparity.T, 1e-12) << "the message's own";
  EXPECT_EQ(other.cx_difference, expected.cx_difference);
}

TEST(CameraConversion, DisparityCameraIgnoresAnUncalibratedRightCamera) {
  const sensor_msgs::CameraInfo left = cameraInfo(smallCamera(), false);
  sensor_msgs::CameraInfo right = cameraInfo(smallCamera(), true);
  right.P[0] = right.P[3] = 0;
  const auto disparity = disparityImage(smallCamera(), exampleHeader(), [](int, int) { return 10.F; });
  EXPECT_NEAR(toDisparityCamera(disparity, "d", left, "l", &right).focalBaseline(), 300 * 0.08, 1e-6);
}

TEST(ImageConversion, MonoImageIsAView) {
  const auto image =
      boost::make_shared<sensor_msgs::Image>(greyImage(8, 4, exampleHeader(), [](int u, int v) { return u + 10 * v; }));
  const cv_bridge::CvImageConstPtr view = toMono(image, "t");
  EXPECT_EQ(view->image.data, image->data.data());
  EXPECT_EQ(view->image.at<std::uint8_t>(3, 5), 35);
}

TEST(ImageConversion, OtherEncodingsBecomeMono) {
  auto image = boost::make_shared<sensor_msgs::Image>(greyImage(8, 4, exampleHeader(), [](int, int) { return 0; }));
  image->encoding = sensor_msgs::image_encodings::BGR8;
  image->step = 24;
  image->data.assign(24 * 4, 77);
  EXPECT_EQ(toMono(image, "t")->image.at<std::uint8_t>(2, 2), 77);
  image->encoding = sensor_msgs::image_encodings::MONO16;
  image->step = 16;
  image->data.assign(16 * 4, 128);  // 0x8080 = 32896
  EXPECT_EQ(toMono(image, "t")->image.at<std::uint8_t>(2, 2), 128);
}

TEST(ImageConversion, BytesWithoutAMeaningAreBrightness) {
  const auto image = boost::make_shared<sensor_msgs::Image>(test::greyImage(8, 6, {}, [](int u, int) { return u; }));
  image->encoding = "8UC1";
  EXPECT_EQ(toMono(image, "left")->image.data, image->data.data());
}

TEST(ImageConversion, AnEncodingThatCannotBeUsedNamesItselfAndThoseThatCan) {
  const auto image = boost::make_shared<sensor_msgs::Image>(test::greyImage(8, 6, {}, [](int u, int) { return u; }));
  image->encoding = "32FC2";
  EXPECT_EQ(errorOf([&] { toMono(image, "/left"); }),
            "/left: encoding is '32FC2', expected mono8, 8UC1, mono16, or one of colour or Bayer images");
  image->encoding = "bgr8";
  EXPECT_EQ(errorOf([&] { toDepth(image, "/depth"); }), "/depth: encoding is 'bgr8', expected 16UC1 or 32FC1");
}

TEST(ImageConversion, NamesTheTopicOfABrokenImage) {
  auto image = boost::make_shared<sensor_msgs::Image>(greyImage(8, 4, exampleHeader(), [](int, int) { return 0; }));
  image->data.resize(20);
  EXPECT_EQ(errorOf([&] { toMono(image, "/stereo/left/image_rect"); }).find("/stereo/left/image_rect: "), 0u);
  image = boost::make_shared<sensor_msgs::Image>(greyImage(8, 4, exampleHeader(), [](int, int) { return 0; }));
  image->encoding = "nonsense";
  EXPECT_EQ(errorOf([&] { toMono(image, "/stereo/left/image_rect"); }).find("/stereo/left/image_rect: "), 0u);
}

/// height * step is 3072 bytes modulo 2^32, as many as there are.
TEST(ImageConversion, RowsThatEndBeyondTheDataAreRefused) {
  auto image = boost::make_shared<sensor_msgs::Image>(test::greyImage(64, 48, {}, [](int, int) { return 7; }));
  image->step = 64 + (1U << 28);
  EXPECT_EQ(errorOf([&] { toMono(image, "/left"); }), "/left: holds 3072 bytes, expected 12884904960 in 48 rows of 268435520");
  EXPECT_NE(errorOf([&] { toDepth(image, "/depth"); }), "");
  image->step = 64;
  EXPECT_EQ(errorOf([&] { toMono(image, "/left"); }), "");
}

TEST(DisparityConversion, IsAViewInWhichInvalidPixelsStayInvalid) {
  const auto message = disparityImage(smallCamera(), exampleHeader(), [](int u, int) {
    return u == 0 ? kNan : u == 1 ? kInf : u == 2 ? -1 : 7.5F;
  });
  const cv::Mat1f view = toDisparities(message, "d", smallCamera());
  EXPECT_EQ(reinterpret_cast<const std::uint8_t*>(view.data), message.image.data.data());
  for (int u = 0; u < 3; ++u) EXPECT_FALSE(core::isValidDisparity(view(100, u))) << u;
  EXPECT_EQ(view(100, 3), 7.5F);
}

TEST(DisparityConversion, PositiveMarkForNoMatchIsRemoved) {
  // stereo_image_proc with min_disparity 16 marks pixels without a match with 15, which would be a wall far away.
  auto message = disparityImage(smallCamera(), exampleHeader(), [](int u, int) { return u == 0 ? 15.F : u == 1 ? kNan : 16.F; });
  message.min_disparity = 16;
  const cv::Mat1f disparities = toDisparities(message, "d", smallCamera());
  EXPECT_FALSE(core::isValidDisparity(disparities(5, 0)));
  EXPECT_FALSE(core::isValidDisparity(disparities(5, 1)));
  EXPECT_EQ(disparities(5, 2), 16.F);
}

TEST(DisparityConversion, NamesTopicAndElementOfABadImage) {
  auto message = disparityImage(smallCamera(), exampleHeader(), [](int, int) { return 1.F; });
  const auto error = [&] { return errorOf([&] { toDisparities(message, "/stereo/disparity", smallCamera()); }); };
  message.image.encoding = "16UC1";
  EXPECT_EQ(error(), "/stereo/disparity: encoding is '16UC1', expected '32FC1'");
  message.image.encoding = "32FC1";
  message.image.height = 200;
  EXPECT_EQ(error(), "/stereo/disparity: size is 320x200, expected 320x240 as its CameraInfo says");
  message.image.height = 240;
  message.image.data.resize(1000);
  EXPECT_EQ(error(), "/stereo/disparity: holds 1000 bytes in rows of 1280, too few for 320x240 pixels");
}

TEST(DisparityConversion, FrameComesBackFromItsMessage) {
  core::DepthFrame frame;
  frame.camera = smallCamera();
  frame.disparity = cv::Mat1f(240, 320, 12.25F);
  frame.disparity(7, 9) = 0;
  const stereo_msgs::DisparityImage message = toMessage(frame, exampleHeader(), 0, 64);
  EXPECT_EQ(message.header.stamp, exampleHeader().stamp);
  EXPECT_EQ(message.image.header.frame_id, "camera");
  EXPECT_EQ(message.f, 300);
  EXPECT_FLOAT_EQ(message.T, 0.08F);
  EXPECT_EQ(message.max_disparity, 63);
  const cv::Mat1f back = toDisparities(message, "d", smallCamera());
  EXPECT_EQ(cv::countNonZero(back != frame.disparity), 0);
}

}  // namespace
}  // namespace cabinet_articulation
