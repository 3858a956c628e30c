// SPDX-License-Identifier: BSD-3-Clause
#include "ros/images/rectifier.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace cabinet_articulation {
namespace {

sensor_msgs::CameraInfo rectifiedCamera() {
  sensor_msgs::CameraInfo info;
  info.width = 320;
  info.height = 240;
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0);
  info.K = {300, 0, 160, 0, 300, 120, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {300, 0, 160, 0, 0, 300, 120, 0, 0, 0, 1, 0};
  return info;
}

/// A soft spot where the camera sees the given ray.
cv::Mat1b spotAt(const sensor_msgs::CameraInfo& info, const cv::Point3d& ray) {
  std::vector<cv::Point2d> pixel;
  cv::projectPoints(std::vector<cv::Point3d>{ray}, cv::Vec3d(), cv::Vec3d(),
                    cv::Mat(3, 3, CV_64F, const_cast<double*>(info.K.data())), info.D, pixel);
  cv::Mat1b image(info.height, info.width);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u)
      image(v, u) = cv::saturate_cast<uchar>(250 * std::exp(-(std::pow(u - pixel[0].x, 2) + std::pow(v - pixel[0].y, 2)) / 18));
  return image;
}

cv::Point2d centroid(const cv::Mat& image) {
  const cv::Moments moments = cv::moments(image);
  return {moments.m10 / moments.m00, moments.m01 / moments.m00};
}

TEST(Rectifier, LeavesRectifiedImagesAlone) {
  const cv::Mat1b image = spotAt(rectifiedCamera(), {0.2, 0.1, 1});
  EXPECT_EQ(Rectifier()(image, rectifiedCamera()).data, image.data);
}

TEST(Rectifier, RemovesLensDistortion) {
  sensor_msgs::CameraInfo info = rectifiedCamera();
  info.D = {-0.3, 0.1, 0.001, -0.001, 0};
  const cv::Mat1b raw = spotAt(info, {0.4, 0.3, 1});
  const cv::Point2d straight(160 + 300 * 0.4, 120 + 300 * 0.3);
  EXPECT_GT(cv::norm(centroid(raw) - straight), 5) << "or this test shows nothing";
  EXPECT_LT(cv::norm(centroid(Rectifier()(raw, info)) - straight), 0.1);
}

TEST(Rectifier, TurnsAndZoomsToo) {
  sensor_msgs::CameraInfo info = rectifiedCamera();
  info.D[0] = 1e-9;
  const double angle = 0.05;
  info.R = {std::cos(angle), 0, std::sin(angle), 0, 1, 0, -std::sin(angle), 0, std::cos(angle)};
  info.P[0] = info.P[5] = 280;
  const cv::Mat1b raw = spotAt(info, {0.1, 0.2, 1});
  const double x = std::cos(angle) * 0.1 + std::sin(angle), z = -std::sin(angle) * 0.1 + std::cos(angle);
  const cv::Point2d turned(160 + 280 * x / z, 120 + 280 * 0.2 / z);
  EXPECT_LT(cv::norm(centroid(Rectifier()(raw, info)) - turned), 0.1);
}

TEST(Rectifier, SaysWhichDistortionModelItDoesNotKnow) {
  sensor_msgs::CameraInfo info = rectifiedCamera();
  info.distortion_model = "mirror_ball";
  info.D[0] = 0.1;
  try {
    Rectifier()(spotAt(rectifiedCamera(), {0, 0, 1}), info);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("mirror_ball"), std::string::npos);
  }
}

TEST(Rectifier, RefusesASensorThatIsTooLargeForItsMaps) {
  sensor_msgs::CameraInfo info = rectifiedCamera();
  info.D[0] = 0.1;
  info.width = info.height = 12000;
  info.roi.width = 320;
  info.roi.height = 240;
  EXPECT_THROW(Rectifier()(spotAt(rectifiedCamera(), {0, 0, 1}), info), std::invalid_argument);
}

TEST(Rectifier, SaysThatALensIsImpossible) {
  sensor_msgs::CameraInfo info = rectifiedCamera();
  info.D.assign(6, 0.1);
  EXPECT_THROW(Rectifier()(spotAt(rectifiedCamera(), {0, 0, 1}), info), std::runtime_error);
}

}  // namespace
}  // namespace cabinet_articulation
