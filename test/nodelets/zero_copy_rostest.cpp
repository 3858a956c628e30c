// SPDX-License-Identifier: BSD-3-Clause
// This program is a nodelet manager: it loads the real nodelets beside one of its own, downstream, that looks at addresses.
#include <cabinet_articulation/PlaneArray.h>
#include <gtest/gtest.h>
#include <nodelet/loader.h>
#include <nodelet/nodelet.h>
#include <ros/console.h>

#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <pluginlib/class_loader.hpp>
#include <sstream>

#include "support/front_scene.h"
#include "support/ros_probe.h"

namespace cabinet_articulation {
namespace {

using test::spinUntil;

/// Text of the form in which the nodelets log what they publish.
std::string at(const std::string& topic, const void* address) {
  std::ostringstream text;
  text << topic << " published at " << address;
  return text.str();
}

struct Seen {
  std::mutex mutex;
  std::map<std::string, int> messages;

  void add(const std::string& message) {
    std::lock_guard<std::mutex> lock(mutex);
    ++messages[message];
  }
  std::map<std::string, int> copy() {
    std::lock_guard<std::mutex> lock(mutex);
    return messages;
  }
};
Seen seen;

/// The test's own downstream nodelet.
class Probe : public nodelet::Nodelet {
  void onInit() override {
    disparity_ = getNodeHandle().subscribe("disparity", 10, &Probe::onDisparity, this);
    planes_ = getNodeHandle().subscribe("planes", 10, &Probe::onPlanes, this);
  }
  void onDisparity(const stereo_msgs::DisparityImageConstPtr& message) { seen.add(at("/disparity", message.get())); }
  void onPlanes(const PlaneArrayConstPtr& message) { seen.add(at("/planes", message.get())); }

  ros::Subscriber disparity_, planes_;
};

TEST(ZeroCopy, DownstreamNodeletsSeeTheVeryMessageThatWasPublished) {
  pluginlib::ClassLoader<nodelet::Nodelet> plugins("nodelet", "nodelet::Nodelet");
  nodelet::Loader loader([&](const std::string& type) {
    return type == "probe" ? boost::shared_ptr<nodelet::Nodelet>(new Probe) : plugins.createInstance(type);
  });
  const nodelet::V_string no_arguments;
  for (const char* stage : {"stereo", "planes"})
    ASSERT_TRUE(loader.load("/" + std::string(stage), "cabinet_articulation/" + std::string(stage), {}, no_arguments));
  ASSERT_TRUE(loader.load("/probe", "probe", {}, no_arguments));

  const test::Recorder<rosgraph_msgs::Log> log("/rosout", 1000);
  ros::NodeHandle nh;
  const core::StereoCamera camera = test::smallCamera();
  const ros::Publisher left = nh.advertise<sensor_msgs::Image>("left/image_rect", 10);
  const ros::Publisher right = nh.advertise<sensor_msgs::Image>("right/image_rect", 10);
  const ros::Publisher left_info = nh.advertise<sensor_msgs::CameraInfo>("left/camera_info", 10);
  const ros::Publisher right_info = nh.advertise<sensor_msgs::CameraInfo>("right/camera_info", 10);
  ASSERT_TRUE(spinUntil([&] { return log.connected() && left.getNumSubscribers() > 0 && right_info.getNumSubscribers() > 0; }));

  std_msgs::Header header;
  header.stamp = ros::Time::now();
  const auto texture = [](int u, int v) { return static_cast<std::uint8_t>((u * 7919 + v * 104729 + (u * v) % 251 * 31) >> 3); };
  const auto announced = [&](const std::string& text) {
    for (const auto& entry : log.messages)
      if (entry->msg.find(text) != std::string::npos) return true;
    return false;
  };
  const auto complete = [&] {
    const auto messages = seen.copy();
    bool disparity = false, planes = false;
    for (const auto& entry : messages) {
      disparity = disparity || (entry.first.rfind("/disparity", 0) == 0 && announced(entry.first));
      planes = planes || (entry.first.rfind("/planes", 0) == 0 && announced(entry.first));
    }
    return disparity && planes;
  };
  EXPECT_TRUE(spinUntil([&] {
    header.stamp += ros::Duration(0.1);
    left_info.publish(test::cameraInfo(camera, false, header));
    right_info.publish(test::cameraInfo(camera, true, header));
    left.publish(test::greyImage(camera.width, camera.height, header, texture));
    right.publish(test::greyImage(camera.width, camera.height, header, [&](int u, int v) { return texture(u + 12, v); }));
    return spinUntil(complete, 0.3);
  })) << "no message arrived at the address at which it was published";
  // Addresses are used again, so a match alone could be luck: every message must have arrived where it was published.
  test::spinFor(0.5);
  for (const auto& entry : seen.copy()) EXPECT_TRUE(announced(entry.first)) << entry.first;
  // Uncompressed images need no plugin; class_loader crashes where stages make several at a time.
  std::ifstream libraries("/proc/self/maps");
  const std::string loaded{std::istreambuf_iterator<char>(libraries), {}};
  EXPECT_NE(loaded.find("libroscpp"), std::string::npos);
  EXPECT_EQ(loaded.find("libimage_transport_plugins"), std::string::npos);
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "zero_copy_rostest");
  ros::console::set_logger_level(ROSCONSOLE_DEFAULT_NAME, ros::console::levels::Debug);
  ros::console::notifyLoggerLevelsChanged();
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
