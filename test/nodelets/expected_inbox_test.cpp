// SPDX-License-Identifier: BSD-3-Clause
#include "nodelets/input/expected_inbox.h"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <future>

namespace cabinet_articulation {
namespace {

constexpr double kGenerous = 30;  ///< [s]

ExpectedFrontArrayConstPtr after(const ros::Time& stamp) {
  const auto message = boost::make_shared<ExpectedFrontArray>();
  message->header.stamp = stamp;
  return message;
}

TEST(ExpectedInbox, GivesWhatIsThereAtOnce) {
  ExpectedInbox inbox;
  inbox.put(after(ros::Time(5)));
  const ExpectedInbox::Answer answer = inbox.after(ros::Time(5), kGenerous);
  EXPECT_TRUE(answer.in_time);
  EXPECT_LT(answer.waited, 1);
  EXPECT_EQ(answer.fronts->header.stamp, ros::Time(5));
}

TEST(ExpectedInbox, WaitsForTheFrameAskedFor) {
  ExpectedInbox inbox;
  inbox.put(after(ros::Time(4)));
  auto answer = std::async(std::launch::async, [&] { return inbox.after(ros::Time(5), kGenerous); });
  EXPECT_EQ(answer.wait_for(std::chrono::milliseconds(50)), std::future_status::timeout);
  inbox.put(after(ros::Time(5)));
  EXPECT_TRUE(answer.get().in_time);
}

TEST(ExpectedInbox, GivesTheNewestOnceTimeIsUp) {
  ExpectedInbox inbox;
  EXPECT_FALSE(inbox.after(ros::Time(5), 0).fronts);
  inbox.put(after(ros::Time(4)));
  const ExpectedInbox::Answer answer = inbox.after(ros::Time(5), 0.02);
  EXPECT_FALSE(answer.in_time);
  EXPECT_GE(answer.waited, 0.02);
  EXPECT_EQ(answer.fronts->header.stamp, ros::Time(4));
  inbox.clear();
  EXPECT_FALSE(inbox.after(ros::Time(4), 0).fronts);
}

TEST(ExpectedInbox, AnInterruptEndsTheWaitAndLaterOnes) {
  ExpectedInbox inbox;
  auto answer = std::async(std::launch::async, [&] { return inbox.after(ros::Time(5), kGenerous); });
  inbox.interrupt();
  EXPECT_FALSE(answer.get().in_time);
  EXPECT_LT(inbox.after(ros::Time(5), kGenerous).waited, 1);
}

}  // namespace
}  // namespace cabinet_articulation
