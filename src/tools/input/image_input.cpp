// SPDX-License-Identifier: BSD-3-Clause
#include "tools/input/image_input.h"

#include <camera_calibration_parsers/parse.h>

#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "cabinet_articulation/ros/image_conversions.h"
#include "config/ordinary_file.h"
#include "ros/images/rectifier.h"
#include "stereo/image_text.h"

namespace cabinet_articulation {
namespace {

constexpr double kVirtualBaseline = 0.075;  ///< [m] a depth sensor's usual one; turns depth into disparity
constexpr double kDepthScale = 1000;        ///< ROS: millimetres
constexpr double kDisparityScale = 256;     ///< KITTI and Middlebury

cv::Mat readImage(const std::string& path, int flags) {
  core::requireOrdinaryFile(path);
  const cv::Mat image = cv::imread(path, flags);
  if (image.empty()) throw std::runtime_error(path + ": no image, or none that can be read");
  return image;
}

/// In metres or pixels.
cv::Mat1f readValues(const std::string& path, double scale) {
  const cv::Mat image = readImage(path, cv::IMREAD_UNCHANGED);
  if (image.type() != CV_16UC1 && image.type() != CV_32FC1)
    throw std::runtime_error(path + ": is " + core::describeImage(image) + ", expected 1 channel with 16 bit or floating point");
  cv::Mat1f values;
  image.convertTo(values, CV_32F, image.type() == CV_16UC1 ? 1 / scale : 1);
  return values;
}

sensor_msgs::CameraInfo readInfo(const std::string& path) {
  core::requireOrdinaryFile(path);
  sensor_msgs::CameraInfo info;
  std::string name;
  if (!camera_calibration_parsers::readCalibration(path, name, info))
    throw std::runtime_error(path + ": no calibration, expected a YAML file as camera_calibration writes it");
  return info;
}

void requireCalibratedSize(const cv::Mat& image, const core::StereoCamera& camera, const std::string& path) {
  if (image.cols != camera.width || image.rows != camera.height)
    throw std::runtime_error(path + ": size is " + std::to_string(image.cols) + "x" + std::to_string(image.rows) + ", expected " +
                             std::to_string(camera.width) + "x" + std::to_string(camera.height) + " as its calibration says");
}

/// A rectified camera with the focal length and principal point of the options.
sensor_msgs::CameraInfo infoOf(const ImageInput& input, const cv::Size& size) {
  if (!input.info.empty()) return readInfo(input.info);
  if (input.fx <= 0) throw std::invalid_argument("--fx or --camera-info is missing");
  const double cx = input.cx < 0 ? (size.width - 1) / 2.0 : input.cx, cy = input.cy < 0 ? (size.height - 1) / 2.0 : input.cy;
  sensor_msgs::CameraInfo info;
  info.width = static_cast<std::uint32_t>(size.width);
  info.height = static_cast<std::uint32_t>(size.height);
  info.P = {input.fx, 0, cx, 0, 0, input.fy > 0 ? input.fy : input.fx, cy, 0, 0, 0, 1, 0};
  return info;
}

/// That of the left one, moved by the baseline, where no calibration is given.
sensor_msgs::CameraInfo rightInfoOf(const ImageInput& input, const sensor_msgs::CameraInfo& left) {
  if (!input.right_info.empty()) return readInfo(input.right_info);
  if (input.baseline <= 0) throw std::invalid_argument("--baseline or --right-info is missing");
  sensor_msgs::CameraInfo info = left;
  info.P[3] = -info.P[0] * input.baseline;
  return info;
}

core::DepthFrame matched(const ImageInput& input, const core::StereoConfig& config) {
  const cv::Mat left = readImage(input.images[0], cv::IMREAD_GRAYSCALE), right = readImage(input.images[1], cv::IMREAD_GRAYSCALE);
  const sensor_msgs::CameraInfo info = infoOf(input, left.size()), right_info = rightInfoOf(input, info);
  const core::StereoCamera camera = toStereoCamera(info, right_info, "left camera", "right camera");
  requireCalibratedSize(left, camera, input.images[0]);
  requireCalibratedSize(right, camera, input.images[1]);
  return core::BlockMatcher(config).process(Rectifier()(left, info), Rectifier()(right, right_info), camera);
}

}  // namespace

core::DepthFrame readFrame(const ImageInput& input, const core::StereoConfig& config) {
  const std::string kind = !input.kind.empty() ? input.kind : input.images.size() == 2 ? "stereo" : "depth";
  if (kind != "depth" && kind != "disparity" && kind != "stereo")
    throw std::invalid_argument("input is '" + kind + "', expected depth, disparity or stereo");
  const size_t expected = kind == "stereo" ? 2 : 1;
  if (input.images.size() != expected)
    throw std::invalid_argument("expected " + std::to_string(expected) + " images of the input " + kind + ", got " +
                                std::to_string(input.images.size()));
  if (kind == "stereo") return matched(input, config);
  const std::string& path = input.images[0];
  const double scale = input.scale > 0 ? input.scale : kind == "depth" ? kDepthScale : kDisparityScale;
  const cv::Mat1f values = readValues(path, scale);
  const sensor_msgs::CameraInfo info = infoOf(input, values.size());
  if (kind == "depth") {
    const core::StereoCamera camera = toDepthCamera(info, "camera", kVirtualBaseline);
    requireCalibratedSize(values, camera, path);
    return core::frameFromDepth(values, camera);
  }
  core::DepthFrame frame;
  frame.camera = toStereoCamera(info, rightInfoOf(input, info), "left camera", "right camera");
  frame.disparity = values;
  requireCalibratedSize(values, frame.camera, path);
  return frame;
}

}  // namespace cabinet_articulation
