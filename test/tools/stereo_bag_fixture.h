// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "cabinet_articulation/geometry/stereo_camera.h"

namespace cabinet_articulation {

constexpr char kOpticalFrame[] = "left_optical";

/// One stereo pair before it is written, so that tests can spoil it.
struct Frame {
  sensor_msgs::Image left, right;
  sensor_msgs::CameraInfo left_info, right_info;
};

/// Bags in a directory of their own, and the program under test.
class StereoBagFixture : public testing::Test {
 protected:
  struct Outcome {
    int status;
    std::string output;  ///< of both streams
  };

  void SetUp() override {
    directory_ = std::filesystem::temp_directory_path() / ("process_bag_test_" + std::to_string(::getpid()));
    std::filesystem::create_directory(directory_);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }

  static std::string bytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  /// Runs process_bag with these arguments, file names within the directory.
  Outcome run(const std::string& arguments) const {
    const std::string log = path("log.txt");
    const int status =
        std::system(("cd " + directory_.string() + " && " PROCESS_BAG " " + arguments + " > " + log + " 2>&1").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, bytes(log)};
  }

  void expectFailure(const std::string& arguments, const std::string& words) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 1) << arguments;
    EXPECT_NE(outcome.output.find(words), std::string::npos) << "expected '" << words << "' in:\n" << outcome.output;
  }

  static sensor_msgs::CameraInfo infoOf(const core::StereoCamera& camera, bool right, const ros::Time& stamp) {
    sensor_msgs::CameraInfo info;
    info.header.stamp = stamp;
    info.header.frame_id = kOpticalFrame;
    info.width = camera.width;
    info.height = camera.height;
    info.distortion_model = "plumb_bob";
    info.D.assign(5, 0);
    info.K = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
    info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    info.P = {camera.fx, 0, camera.cx, right ? -camera.fx * camera.baseline : 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
    return info;
  }

  static sensor_msgs::Image imageOf(const cv::Mat& image, const ros::Time& stamp, const char* encoding = "mono8") {
    std_msgs::Header header;
    header.stamp = stamp;
    header.frame_id = kOpticalFrame;
    return *cv_bridge::CvImage(header, encoding, image).toImageMsg();
  }

  static void write(rosbag::Bag& bag, const Frame& frame, const ros::Time& time) {
    bag.write("/stereo/left/image_raw", time, frame.left);
    bag.write("/stereo/right/image_raw", time, frame.right);
    bag.write("/stereo/left/camera_info", time, frame.left_info);
    bag.write("/stereo/right/camera_info", time, frame.right_info);
  }

  std::filesystem::path directory_;
};

}  // namespace cabinet_articulation
