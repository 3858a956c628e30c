// SPDX-License-Identifier: BSD-3-Clause
#include <cabinet_articulation/TrackArray.h>
#include <gtest/gtest.h>
#include <tf2_msgs/TFMessage.h>

#include "support/ros_probe.h"

namespace cabinet_articulation {
namespace {

using test::spinUntil;

// A program of its own: a nodelet that has looked up one transform goes on listening.
TEST(TrackingNodelet, ListensToTfBeforeItsFirstFrame) {
  const test::Recorder<TrackArray> tracks("tracks");
  ros::NodeHandle nh;
  const ros::Publisher tf = nh.advertise<tf2_msgs::TFMessage>("/tf", 1);
  EXPECT_TRUE(spinUntil([&] { return tf.getNumSubscribers() > 0; }));
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "tracking_tf_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
