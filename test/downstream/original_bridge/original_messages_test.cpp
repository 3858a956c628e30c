// SPDX-License-Identifier: BSD-3-Clause
// ROS connects only programs whose message definitions have the same MD5 sum.
#include <articulation_msgs/ArticulatedObjectMsg.h>
#include <articulation_msgs/ArticulatedObjectSrv.h>
#include <articulation_msgs/GetModelPriorSrv.h>
#include <articulation_msgs/ModelMsg.h>
#include <articulation_msgs/ParamMsg.h>
#include <articulation_msgs/SetModelPriorSrv.h>
#include <articulation_msgs/TrackModelSrv.h>
#include <articulation_msgs/TrackMsg.h>
#include <gtest/gtest.h>
#include <ros/message_traits.h>
#include <ros/service_traits.h>

namespace articulation_msgs {
namespace {

template <class Message>
std::string messageSum() {
  return ros::message_traits::md5sum<Message>();
}

template <class Service>
std::string serviceSum() {
  return ros::service_traits::md5sum<Service>();
}

// Of the definitions in the original's repository, https://github.com/tum-vision/articulation, computed by genmsg.
TEST(OriginalMessages, ProgramsOfTheOriginalReleaseConnect) {
  EXPECT_EQ(messageSum<ParamMsg>(), "6b116ef40eb37aa2f03e65c1a95f8bf1");
  EXPECT_EQ(messageSum<TrackMsg>(), "f74375fd0f97f92e2767ab0a80c15590");
  EXPECT_EQ(messageSum<ModelMsg>(), "d6fd23ca956a2c6fee31f2452ddba34d");
  EXPECT_EQ(messageSum<ArticulatedObjectMsg>(), "3b21072d43285856ae510b328c85e0a6");
  EXPECT_EQ(serviceSum<TrackModelSrv>(), "c9416af83362c7c0e98c9f877c3e7b6b");
  EXPECT_EQ(serviceSum<GetModelPriorSrv>(), "492b025b4d335f83e3fab65eb3211a27");
  EXPECT_EQ(serviceSum<SetModelPriorSrv>(), "492b025b4d335f83e3fab65eb3211a27");
  EXPECT_EQ(serviceSum<ArticulatedObjectSrv>(), "8f11f7b1efb69e25af0a7d71f286c03c");
}

}  // namespace
}  // namespace articulation_msgs
