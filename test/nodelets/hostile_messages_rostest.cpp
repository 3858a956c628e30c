// SPDX-License-Identifier: BSD-3-Clause
#include <cabinet_articulation/ArticulationModelArray.h>
#include <cabinet_articulation/PlaneArray.h>
#include <cabinet_articulation/RectangleArray.h>
#include <cabinet_articulation/Timing.h>
#include <cabinet_articulation/TrackArray.h>
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "cabinet_articulation/ros/image_conversions.h"
#include "support/front_scene.h"
#include "support/ros_messages.h"
#include "support/ros_probe.h"

namespace cabinet_articulation {
namespace {

using test::spinUntil;

/// All stages in one manager; the test's messages come among their own.
class HostileMessages : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(spinUntil([&] {
      for (const ros::Publisher* input :
           {&left_, &right_, &left_info_, &right_info_, &disparity_, &planes_, &rectangles_, &tracks_, &models_})
        if (input->getNumSubscribers() == 0) return false;
      return timing_.connected();
    }));
  }

  std_msgs::Header now() const {
    std_msgs::Header header;
    header.frame_id = "optical";
    header.stamp = ros::Time::now();
    return header;
  }

  /// How often each stage has worked.
  std::map<std::string, int> worked() const {
    std::map<std::string, int> count;
    for (const TimingConstPtr& timing : timing_.messages) ++count[timing->stage];
    return count;
  }

  void publishPair(const std_msgs::Header& header, double P0 = 0) {
    sensor_msgs::CameraInfo left = test::cameraInfo(scene_.camera, false, header);
    if (P0 > 0) left.P[0] = P0;
    left_info_.publish(left);
    right_info_.publish(test::cameraInfo(scene_.camera, true, header));
    const auto grey =
        test::greyImage(scene_.camera.width, scene_.camera.height, header, [](int u, int v) { return (u * 7 + v * 13) % 251; });
    left_.publish(grey);
    right_.publish(grey);
  }

  void publishDisparity(const std_msgs::Header& header) { disparity_.publish(scene_.disparityMessage(header)); }

  template <class Message>
  Message empty(const std_msgs::Header& header) const {
    Message message;
    message.header = header;
    return message;
  }

  /// True once a stage says so, whose cause is published again and again.
  bool isSaid(const std::string& stage, const std::string& text, const std::function<void()>& cause) {
    return spinUntil([&] {
      cause();
      return spinUntil([&] { return reports_.statusHas(stage, text); }, 0.5);
    });
  }

  /// Every stage works on good input. A stage without images to pair works on what the stage before publishes.
  void expectAllWork() {
    auto before = worked();
    EXPECT_TRUE(spinUntil([&] {
      const std_msgs::Header header = now();
      publishPair(header);
      publishDisparity(header);
      rectangles_.publish(empty<RectangleArray>(header));
      return spinUntil(
          [&] {
            auto after = worked();
            for (const char* stage : {"stereo", "planes", "rectangles", "tracking", "articulation", "overlay"})
              if (after[stage] <= before[stage]) return false;
            return true;
          },
          0.5);
    }));
    for (const auto& [stage, count] : worked()) RecordProperty(stage, count - before[stage]);
  }

  const test::FrontScene scene_;
  ros::NodeHandle nh_;
  ros::Publisher left_ = nh_.advertise<sensor_msgs::Image>("left/image_rect", 10);
  ros::Publisher right_ = nh_.advertise<sensor_msgs::Image>("right/image_rect", 10);
  ros::Publisher left_info_ = nh_.advertise<sensor_msgs::CameraInfo>("left/camera_info", 10);
  ros::Publisher right_info_ = nh_.advertise<sensor_msgs::CameraInfo>("right/camera_info", 10);
  ros::Publisher disparity_ = nh_.advertise<stereo_msgs::DisparityImage>("disparity", 10);
  ros::Publisher planes_ = nh_.advertise<PlaneArray>("planes", 10);
  ros::Publisher rectangles_ = nh_.advertise<RectangleArray>("rectangles", 10);
  ros::Publisher tracks_ = nh_.advertise<TrackArray>("tracks", 10);
  ros::Publisher models_ = nh_.advertise<ArticulationModelArray>("models", 10);
  test::Recorder<Timing> timing_{"timing", 1000};
  test::Reports reports_;
};

TEST_F(HostileMessages, StampsAtTheEndOfTimeAreRefusedInWords) {
  expectAllWork();
  std_msgs::Header last = now();
  last.stamp = ros::Time(4294967290U, 0);
  const std::string text = "header.stamp is 4294967290 s, expected";
  EXPECT_TRUE(isSaid("stereo", text, [&] { publishPair(last); }));
  EXPECT_TRUE(isSaid("planes", text, [&] { publishDisparity(last); }));
  EXPECT_TRUE(isSaid("rectangles", text, [&] { planes_.publish(empty<PlaneArray>(last)); }));
  EXPECT_TRUE(isSaid("tracking", text, [&] { rectangles_.publish(empty<RectangleArray>(last)); }));
  EXPECT_TRUE(isSaid("articulation", text, [&] { tracks_.publish(empty<TrackArray>(last)); }));
  EXPECT_TRUE(isSaid("overlay", text, [&] { models_.publish(empty<ArticulationModelArray>(last)); }));
  expectAllWork();
}

TEST_F(HostileMessages, StampsFarApartEndNothing) {
  std_msgs::Header first = now(), later = now();
  first.stamp = ros::Time(1, 0);
  later.stamp = ros::Time(4000000000U, 0);
  for (const std_msgs::Header& header : {first, later, first}) {
    publishPair(header);
    publishDisparity(header);
    planes_.publish(empty<PlaneArray>(header));
    rectangles_.publish(empty<RectangleArray>(header));
    tracks_.publish(empty<TrackArray>(header));
    models_.publish(empty<ArticulationModelArray>(header));
    test::spinFor(0.3);
  }
  expectAllWork();
}

TEST_F(HostileMessages, HullsAndCamerasFarOutOfRangeAreRefusedInWords) {
  EXPECT_TRUE(isSaid("rectangles", "hull's x is 3e+38, expected", [&] {
    const std_msgs::Header header = now();
    left_info_.publish(test::cameraInfo(scene_.camera, false, header));
    PlaneArray message = empty<PlaneArray>(header);
    message.planes.resize(1);
    Plane& plane = message.planes[0];
    plane.coefficients = {0, 0, -1, 1.2};
    plane.mask = test::greyImage(scene_.camera.width, scene_.camera.height, header, [](int, int) { return 255; });
    plane.hull.resize(3);
    plane.hull[0].x = 3e38F;
    plane.hull[1].y = 100;
    planes_.publish(message);
    publishPair(header);  // for which the disparity waits
    publishDisparity(header);
  }));
  for (const double focal_length : {1e38, 1e300, 1e-300, 1e-3, 1e10}) publishPair(now(), focal_length), test::spinFor(0.2);
  EXPECT_TRUE(isSaid("stereo", "focal length fx (P[0]) is 1e+38, expected 1 to 100000 px", [&] { publishPair(now(), 1e38); }));
  expectAllWork();
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "hostile_messages_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
