// SPDX-License-Identifier: BSD-3-Clause
#include "pair_matcher.h"

#include <gtest/gtest.h>
#include <sensor_msgs/Image.h>

#include <boost/make_shared.hpp>

#include "clock_jump.h"

namespace cabinet_articulation {
namespace {

using Matcher = PairMatcher<sensor_msgs::Image>;

sensor_msgs::ImageConstPtr imageAt(double stamp) {
  const auto image = boost::make_shared<sensor_msgs::Image>();
  image->header.stamp = ros::Time(stamp);
  return image;
}

TEST(PairMatcher, FindsPartnersInWhateverOrderTheyCome) {
  Matcher matcher(0);
  const auto left1 = imageAt(1), left2 = imageAt(2), right1 = imageAt(1), right2 = imageAt(2);
  EXPECT_FALSE(matcher.add(Side::kLeft, left1));
  EXPECT_FALSE(matcher.add(Side::kLeft, left2));
  const auto first = matcher.add(Side::kRight, right1);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->left, left1);
  EXPECT_EQ(first->right, right1);
  const auto second = matcher.add(Side::kRight, right2);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->left, left2);
}

TEST(PairMatcher, ToleratesWhatItIsToldTo) {
  Matcher exact(0), approximate(0.01);
  for (Matcher* matcher : {&exact, &approximate}) matcher->add(Side::kLeft, imageAt(1));
  EXPECT_FALSE(exact.add(Side::kRight, imageAt(1.004)));
  EXPECT_TRUE(approximate.add(Side::kRight, imageAt(1.004)));
  EXPECT_FALSE(approximate.add(Side::kRight, imageAt(1.02)));
}

TEST(PairMatcher, KnowsByHowMuchTheStampsDiffer) {
  Matcher matcher(0);
  for (int i = 0; i < 4; ++i) {
    EXPECT_FALSE(matcher.mismatch()) << "a few lonely images are normal";
    matcher.add(Side::kLeft, imageAt(1 + 0.1 * i));
    matcher.add(Side::kRight, imageAt(1.033 + 0.1 * i));
  }
  ASSERT_TRUE(matcher.mismatch());
  EXPECT_NEAR(*matcher.mismatch(), 0.033, 1e-6);
  matcher.add(Side::kLeft, imageAt(2));
  EXPECT_TRUE(matcher.add(Side::kRight, imageAt(2)));
  EXPECT_FALSE(matcher.mismatch());
}

TEST(PairMatcher, SilenceOfOneSideIsNoMismatch) {
  Matcher matcher(0);
  for (int i = 0; i < 20; ++i) matcher.add(Side::kLeft, imageAt(1 + 0.1 * i));
  EXPECT_FALSE(matcher.mismatch());
}

TEST(PairMatcher, FindsPairsAfterTheClockWasSetBack) {
  Matcher matcher(0);
  for (int i = 0; i < 20; ++i) matcher.add(Side::kLeft, imageAt(100 + i));
  matcher.add(Side::kLeft, imageAt(1));
  EXPECT_TRUE(matcher.add(Side::kRight, imageAt(1)));
}

TEST(RecentMessages, ForgetsTheOldestAndPrefersTheNewestOfEqualStamps) {
  RecentMessages<sensor_msgs::Image> messages(2);
  const auto again = imageAt(1);
  messages.add(imageAt(1));
  messages.add(again);
  EXPECT_EQ(messages.find(ros::Time(1)), again);
  messages.add(imageAt(2));
  messages.add(imageAt(3));
  EXPECT_FALSE(messages.find(ros::Time(1)));
  EXPECT_EQ(messages.nearest(ros::Time(1))->header.stamp, ros::Time(2));
}

TEST(ClockJump, IsAJumpBackByMoreThanDisorder) {
  ClockJump jumped;
  EXPECT_FALSE(jumped(ros::Time(10)));
  EXPECT_FALSE(jumped(ros::Time(11)));
  EXPECT_FALSE(jumped(ros::Time(10.5))) << "out of order";
  EXPECT_TRUE(jumped(ros::Time(5)));
  EXPECT_FALSE(jumped(ros::Time(5.1)));
  EXPECT_FALSE(jumped(ros::Time(1000))) << "forward is no jump back";
}

}  // namespace
}  // namespace cabinet_articulation
