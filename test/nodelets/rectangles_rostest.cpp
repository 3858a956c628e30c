// SPDX-License-Identifier: BSD-3-Clause
#include <cabinet_articulation/PlaneArray.h>
#include <cabinet_articulation/RectangleArray.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cabinet_articulation/ros/conversions.h"
#include "support/front_scene.h"
#include "support/ros_probe.h"

namespace cabinet_articulation {
namespace {

using test::Recorder;
using test::spinUntil;

/// The planes nodelet segments what the test publishes; rectangles works on both.
class RectanglesNodelet : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(spinUntil([&] {
      // Both nodelets need disparity and camera.
      return rectangles_.connected() && disparity_.getNumSubscribers() == 1 && info_.getNumSubscribers() == 1;
    }));
  }

  void publish() {
    std_msgs::Header header;
    header.frame_id = "optical";
    header.stamp = stamp_ += ros::Duration(0.1);
    info_.publish(test::cameraInfo(scene_.camera, false, header));
    disparity_.publish(scene_.disparityMessage(header));
  }

  RectangleArray answer() {
    const size_t before = rectangles_.messages.size();
    const bool came = spinUntil([&] {
      publish();
      return spinUntil([&] { return rectangles_.messages.size() > before; }, 0.3);
    });
    return came ? *rectangles_.messages.back() : RectangleArray();
  }

  const test::FrontScene scene_;
  ros::Time stamp_ = ros::Time::now();
  ros::NodeHandle nh_;
  ros::Publisher info_ = nh_.advertise<sensor_msgs::CameraInfo>("left/camera_info", 10);
  ros::Publisher disparity_ = nh_.advertise<stereo_msgs::DisparityImage>("disparity", 10);
  Recorder<RectangleArray> rectangles_{"rectangles"};
  test::Reports reports_;
};

/// One rectangle, and it is the front: a pixel is 4 mm at this distance, and the input has no noise.
void expectFront(const RectangleArray& message, const core::Rectangle& front) {
  ASSERT_EQ(message.rectangles.size(), 1u);
  const core::DetectedRectangle found = fromMessage(message.rectangles[0]);
  EXPECT_LT((found.rectangle.center() - front.center()).norm(), 0.006);
  EXPECT_GT(found.rectangle.normal().dot(front.normal()), std::cos(0.01));
  EXPECT_GT(core::intersectionOverUnion(front, found.rectangle), 0.95);
  EXPECT_GT(found.precision, 0.9);
  EXPECT_GT(found.covariance(0, 0), 0) << "a rectangle knows how sure it is";
}

TEST_F(RectanglesNodelet, FindsTheFront) {
  const RectangleArray rectangles = answer();
  expectFront(rectangles, scene_.front);
  EXPECT_EQ(rectangles.header.frame_id, "optical");
  EXPECT_FALSE(rectangles.header.stamp.isZero());
}

TEST_F(RectanglesNodelet, ExpectationsThatCannotBePlacedNeverBlock) {
  ros::Publisher expected = nh_.advertise<ExpectedFrontArray>("expected_fronts", 1);
  ASSERT_TRUE(spinUntil([&] { return expected.getNumSubscribers() > 0; }));
  core::ExpectedFronts hint;
  hint.fronts.resize(1);
  hint.fronts[0].rectangle = scene_.front;
  std_msgs::Header header;
  header.frame_id = "nowhere";
  expected.publish(toMessage(hint, header));
  EXPECT_TRUE(spinUntil([&] {
    expectFront(answer(), scene_.front);
    return reports_.statusHas("rectangles", "no transform from 'nowhere' to 'optical'");
  })) << reports_.status("rectangles");
  header.frame_id = "optical";
  expected.publish(toMessage(hint, header));
  expectFront(answer(), scene_.front);
}

TEST(LazyRectanglesNodelet, TheWholeChainSleepsWhileNobodyListens) {
  ros::NodeHandle nh;
  const ros::Publisher disparity = nh.advertise<stereo_msgs::DisparityImage>("disparity", 10);
  test::Reports reports;
  ASSERT_TRUE(spinUntil([&] { return reports.statusHas("rectangles", "idle") && reports.statusHas("planes", "idle"); }));
  EXPECT_EQ(disparity.getNumSubscribers(), 0u);
  {
    const Recorder<RectangleArray> listener("rectangles");
    EXPECT_TRUE(spinUntil([&] { return reports.statusHas("planes", "/disparity: nothing received"); })) << "planes is awake too";
  }
  EXPECT_TRUE(spinUntil([&] { return disparity.getNumSubscribers() == 0; }));
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "rectangles_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
