// SPDX-License-Identifier: BSD-3-Clause
#include "ros/checks/clock_jump.h"

#include <gtest/gtest.h>

namespace cabinet_articulation {
namespace {

TEST(ClockJump, IsMoreThanFramesOutOfOrder) {
  ClockJump jumped;
  EXPECT_FALSE(jumped(ros::Time(100)));
  EXPECT_FALSE(jumped(ros::Time(99.5)));
  EXPECT_FALSE(jumped(ros::Time(99)));
  EXPECT_TRUE(jumped(ros::Time(98.9)));
  EXPECT_FALSE(jumped(ros::Time(99)));
}

TEST(ClockJump, KnowsTheNewestStampSinceTheJump) {
  ClockJump jumped;
  EXPECT_FALSE(jumped.newest());
  jumped(ros::Time(100));
  jumped(ros::Time(99.5));
  EXPECT_EQ(*jumped.newest(), ros::Time(100));
  jumped(ros::Time(5));
  EXPECT_EQ(*jumped.newest(), ros::Time(5));
}

TEST(ClockJump, TellsWhereAFrameBelongs) {
  ClockJump clock;
  EXPECT_EQ(clock.orderOf(ros::Time(100)), FrameOrder::kNewer) << "the first";
  EXPECT_EQ(clock.orderOf(ros::Time(100)), FrameOrder::kNotNewer);
  EXPECT_EQ(clock.orderOf(ros::Time(99.5)), FrameOrder::kNotNewer);
  EXPECT_EQ(clock.orderOf(ros::Time(100.1)), FrameOrder::kNewer);
  EXPECT_EQ(clock.orderOf(ros::Time(5)), FrameOrder::kSetBack);
  EXPECT_EQ(clock.orderOf(ros::Time(5.1)), FrameOrder::kNewer);
}

TEST(ClockJump, KnowsAllTimesThatAMessageHolds) {
  ClockJump jumped;
  EXPECT_FALSE(jumped(ros::Time(0)));
  EXPECT_FALSE(jumped(ros::TIME_MAX));
  EXPECT_FALSE(jumped(ros::TIME_MAX));
  EXPECT_TRUE(jumped(ros::Time(0)));
  EXPECT_FALSE(jumped(ros::Time(0.1)));
}

}  // namespace
}  // namespace cabinet_articulation
