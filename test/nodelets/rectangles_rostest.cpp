// SPDX-License-Identifier: BSD-3-Clause
#include <cabinet_articulation/PlaneArray.h>
#include <cabinet_articulation/RectangleArray.h>
#include <cabinet_articulation/Timing.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

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
      return rectangles_->connected() && disparity_.getNumSubscribers() == 1 && info_.getNumSubscribers() == 1;
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
    const size_t before = rectangles_->messages.size();
    const bool came = spinUntil([&] {
      publish();
      return spinUntil([&] { return rectangles_->messages.size() > before; }, 0.3);
    });
    return came ? *rectangles_->messages.back() : RectangleArray();
  }

  const test::FrontScene scene_;
  ros::Time stamp_ = ros::Time::now();
  ros::NodeHandle nh_;
  ros::Publisher info_ = nh_.advertise<sensor_msgs::CameraInfo>("left/camera_info", 10);
  ros::Publisher disparity_ = nh_.advertise<stereo_msgs::DisparityImage>("disparity", 10);
  std::unique_ptr<Recorder<RectangleArray>> rectangles_ = std::make_unique<Recorder<RectangleArray>>("rectangles");
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

/// A tracker that says what it expects after each frame, if at all.
class RectanglesNodeletBesideATracker : public RectanglesNodelet {
 protected:
  void SetUp() override {
    RectanglesNodelet::SetUp();
    ASSERT_TRUE(spinUntil([&] { return expected_.getNumSubscribers() > 0 && timing_.connected(); }));
    hint_.fronts.resize(1);
    hint_.fronts[0].rectangle = scene_.front;
    hint_.fronts[0].stamp = stamp_.toSec();
    header_.frame_id = "optical";
    // The first frame may come before everything listens; from then on each is answered.
    answer();
    ASSERT_TRUE(spinUntil([&] { return rectangles_->messages.back()->header.stamp == stamp_; }));
  }

  /// What the rectangles of one frame took.
  Timing frame() {
    publish();
    Timing found;
    EXPECT_TRUE(spinUntil([&] {
      for (const auto& timing : timing_.messages)
        if (timing->stage == "rectangles" && timing->header.stamp == stamp_) found = *timing;
      return found.header.stamp == stamp_ && rectangles_->messages.back()->header.stamp == stamp_;
    }));
    expectFront(*rectangles_->messages.back(), scene_.front);
    header_.stamp = stamp_;
    return found;
  }

  core::ExpectedFronts hint_;
  std_msgs::Header header_;  ///< of what the tracker says: the stamp is that of the newest rectangles
  ros::Publisher expected_ = nh_.advertise<ExpectedFrontArray>("expected_fronts", 1);
  Recorder<Timing> timing_{"timing", 1000};
};

TEST_F(RectanglesNodeletBesideATracker, WaitsForTheTracksAfterTheFrameBefore) {
  frame();
  for (int i = 0; i < 3; ++i) {
    expected_.publish(toMessage(hint_, header_));
    const Timing timing = frame();
    EXPECT_FALSE(timing.incomplete);
    EXPECT_GT(timing.milliseconds, 0);
  }
}

TEST_F(RectanglesNodeletBesideATracker, WaitsNoLongerThanAFrameAndSaysSo) {
  frame();
  const Timing timing = frame();
  EXPECT_TRUE(timing.incomplete);
  EXPECT_GE(timing.waited, 100) << "frames come every 0.1 s by their stamps";
  EXPECT_TRUE(spinUntil([&] {
    return reports_.statusHas("rectangles", "the tracks after the frame before did not come within a frame's time, 100 ms");
  })) << reports_.status("rectangles");
}

TEST_F(RectanglesNodeletBesideATracker, FramesThatAreDroppedMakeNoWaitLonger) {
  frame();
  const std::size_t before = timing_.messages.size();
  for (int i = 0; i < 20; ++i) {
    publish();
    test::spinFor(0.03);
  }
  frame();
  int waits = 0;
  for (std::size_t i = before; i < timing_.messages.size(); ++i) {
    if (timing_.messages[i]->stage != "rectangles") continue;
    EXPECT_LT(timing_.messages[i]->waited, 200) << "frames come every 0.1 s by their stamps";
    ++waits;
  }
  EXPECT_GE(waits, 3);
}

TEST_F(RectanglesNodeletBesideATracker, ANewSubscriptionWaitsForNoFrameOfTheLast) {
  frame();
  rectangles_.reset();
  ASSERT_TRUE(spinUntil([&] { return reports_.statusHas("rectangles", "idle") && expected_.getNumSubscribers() == 0; }));
  rectangles_ = std::make_unique<Recorder<RectangleArray>>("rectangles");
  ASSERT_TRUE(spinUntil([&] {
    return expected_.getNumSubscribers() > 0 && disparity_.getNumSubscribers() == 1 && info_.getNumSubscribers() == 1;
  }));
  test::spinFor(0.2);
  const Timing first = frame();
  EXPECT_FALSE(first.incomplete);
  EXPECT_LT(first.waited, 50);
}

TEST_F(RectanglesNodeletBesideATracker, TimeThatIsSetBackWaitsForNoFrame) {
  frame();
  stamp_ -= ros::Duration(100);
  const Timing back = frame();
  EXPECT_FALSE(back.incomplete);
  EXPECT_LT(back.waited, 50);
}

TEST_F(RectanglesNodeletBesideATracker, FramesOutOfOrderAreSkippedInWords) {
  frame();
  const ros::Time newest = stamp_;
  stamp_ -= ros::Duration(0.2);
  publish();
  EXPECT_TRUE(spinUntil([&] { return reports_.statusHas("rectangles", "is not newer than that of the frame before"); }));
  EXPECT_EQ(rectangles_->messages.back()->header.stamp, newest);
}

TEST_F(RectanglesNodeletBesideATracker, ExpectationsThatCannotBePlacedAreLeftOut) {
  header_.frame_id = "nowhere";
  EXPECT_TRUE(spinUntil([&] {
    frame();
    expected_.publish(toMessage(hint_, header_));
    return frame().incomplete && reports_.statusHas("rectangles", "no transform from 'optical' to 'nowhere'");
  })) << reports_.status("rectangles");
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
