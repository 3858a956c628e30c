// SPDX-License-Identifier: BSD-3-Clause
#include "ros/input/pair_matcher.h"

#include <gtest/gtest.h>
#include <sensor_msgs/Image.h>

#include <boost/make_shared.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "ros/input/recent_messages.h"

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

TEST(PairMatcher, AMessageBelongsToOnePairAtMost) {
  Matcher matcher(0.01);
  matcher.add(Side::kLeft, imageAt(1));
  EXPECT_TRUE(matcher.add(Side::kRight, imageAt(1.001)));
  EXPECT_FALSE(matcher.add(Side::kLeft, imageAt(1.002)));
}

TEST(PairMatcher, GivesUpWhatArrivedBeforeAPair) {
  std::vector<std::pair<Side, ros::Time>> lonely;
  Matcher matcher(0, [&](Side side, const auto& image) { lonely.emplace_back(side, image->header.stamp); });
  matcher.add(Side::kLeft, imageAt(1));
  matcher.add(Side::kRight, imageAt(2));
  matcher.add(Side::kLeft, imageAt(3));
  matcher.add(Side::kLeft, imageAt(4));
  EXPECT_TRUE(lonely.empty());
  EXPECT_TRUE(matcher.add(Side::kRight, imageAt(3)));
  const std::vector<std::pair<Side, ros::Time>> before{{Side::kLeft, ros::Time(1)}, {Side::kRight, ros::Time(2)}};
  EXPECT_EQ(lonely, before);
  lonely.clear();
  matcher.giveUpAll();
  EXPECT_EQ(lonely, (std::vector<std::pair<Side, ros::Time>>{{Side::kLeft, ros::Time(4)}}));
}

TEST(PairMatcher, KeepsAFewMessagesOfASideWhoseOtherSideIsSilent) {
  int lonely = 0;
  Matcher matcher(0, [&](Side, const auto&) { ++lonely; });
  for (int i = 0; i < 1000; ++i) matcher.add(Side::kLeft, imageAt(1 + i));
  EXPECT_GE(lonely, 960);
  EXPECT_TRUE(matcher.add(Side::kRight, imageAt(990))) << "a second's worth";
}

/// The pairs of two cameras that lose images and have no common trigger, as text. `order` says how the sides interleave.
std::string pairsOf(double tolerance, unsigned order) {
  std::mt19937 losses(3), interleaving(order);
  std::vector<sensor_msgs::ImageConstPtr> sides[2];
  for (int i = 0; i < 300; ++i)
    for (const int side : {0, 1})
      if (losses() % 4 > 0) {
        const double jitter = 0.03 * side + 0.0001 * (losses() % 400);
        sides[side].push_back(imageAt(1 + 0.1 * i + (tolerance > 0 ? jitter : 0)));
      }
  Matcher matcher(tolerance);
  std::string pairs;
  size_t next[2] = {0, 0};
  while (next[0] < sides[0].size() || next[1] < sides[1].size()) {
    size_t side = interleaving() % 2;
    const auto over = [&](size_t s) { return next[s] >= sides[s].size(); };
    const auto stamp = [&](size_t s) { return sides[s][next[s]]->header.stamp; };
    // Neither camera runs ahead of the other by more than a matcher remembers.
    if (over(side) || (!over(1 - side) && stamp(side) > stamp(1 - side) + ros::Duration(1))) side = 1 - side;
    if (const auto pair = matcher.add(side == 0 ? Side::kLeft : Side::kRight, sides[side][next[side]++]))
      for (const auto& image : {pair->left, pair->right}) pairs += std::to_string(image->header.stamp.toSec()) + "\n";
  }
  return pairs;
}

TEST(PairMatcher, AllWhoHearTheSameTopicsComeToTheSamePairs) {
  for (const double tolerance : {0.0, 0.02, 0.06, 0.1}) {
    const std::string pairs = pairsOf(tolerance, 0);
    EXPECT_GT(std::count(pairs.begin(), pairs.end(), '\n'), 30) << "or this test shows nothing, at tolerance " << tolerance;
    for (unsigned order = 1; order < 50; ++order) ASSERT_EQ(pairsOf(tolerance, order), pairs) << order << " at " << tolerance;
  }
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
  EXPECT_EQ(messages.newest()->header.stamp, ros::Time(3));
}

}  // namespace
}  // namespace cabinet_articulation
