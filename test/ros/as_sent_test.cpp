// SPDX-License-Identifier: BSD-3-Clause
// The pipeline in one object passes between its stages what messages would deliver, to the bit.
#include "pipeline/as_sent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "geometry/message_precision.h"

namespace cabinet_articulation {
namespace {

constexpr int kSamples = 1000;

/// Rotations as products of rotations leave them, not just as a quaternion gives them.
class AsSent : public testing::Test {
 protected:
  core::Rectangle rectangle() {
    core::Rectangle rectangle;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d axis = Eigen::Vector3d(number_(random_), number_(random_), number_(random_)).normalized();
      rectangle.pose = rectangle.pose * Eigen::AngleAxisd(3 * number_(random_), axis) *
                       Eigen::Translation3d(number_(random_), number_(random_), number_(random_));
    }
    rectangle.width = 0.01 + std::abs(number_(random_));
    rectangle.height = 0.01 + std::abs(number_(random_));
    return rectangle;
  }

  core::Matrix6d covariance() {
    core::Matrix6d root;
    for (int i = 0; i < 36; ++i) root(i / 6, i % 6) = number_(random_);
    return root * root.transpose();
  }

  /// Times of today that came from a message.
  double stampOfToday() { return ros::Time(1795000000 + random_() % 1000, random_() % 1000000000).toSec(); }

  std::uniform_real_distribution<double> seconds_{0, 2e9};
  std_msgs::Header header_;
  std::mt19937 random_{1};
  std::uniform_real_distribution<double> number_{-1, 1};
};

void expectSame(const core::Rectangle& a, const core::Rectangle& b) {
  EXPECT_EQ(a.pose.matrix(), b.pose.matrix());
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
}

TEST_F(AsSent, TimesAreWhatMessagesDeliver) {
  std::uniform_real_distribution<double> exponent(-12, 9);
  for (int i = 0; i < kSamples; ++i)
    for (const double stamp : {seconds_(random_), std::pow(10, exponent(random_)), stampOfToday(), -seconds_(random_)})
      EXPECT_EQ(core::asSent(stamp), toStamp(stamp).toSec()) << stamp;
  const double today = stampOfToday();
  EXPECT_EQ(core::asSent(today), today) << "what came from a message stays";
}

TEST_F(AsSent, RectanglesAreWhatMessagesDeliver) {
  std::vector<core::DetectedRectangle> rectangles(kSamples);
  for (auto& detected : rectangles) {
    detected.rectangle = rectangle();
    detected.covariance = covariance();
    detected.precision = std::abs(number_(random_));
    detected.recall = std::abs(number_(random_));
    detected.edge_support = {0.1F, 0.7F, 1, 0};
  }
  const auto sent = core::asSent(rectangles);
  const auto delivered = fromMessage(toMessage(rectangles, header_));
  ASSERT_EQ(delivered.size(), sent.size());
  bool differ = false;
  for (size_t i = 0; i < sent.size(); ++i) {
    expectSame(sent[i].rectangle, delivered[i].rectangle);
    EXPECT_EQ(sent[i].covariance, delivered[i].covariance);
    EXPECT_EQ(sent[i].precision, delivered[i].precision);
    EXPECT_EQ(sent[i].recall, delivered[i].recall);
    EXPECT_EQ(sent[i].edge_support, delivered[i].edge_support);
    differ = differ || sent[i].rectangle.pose.matrix() != rectangles[i].rectangle.pose.matrix();
  }
  EXPECT_TRUE(differ) << "a message changes the last bits; else none of this were needed";
}

TEST_F(AsSent, ExpectedFrontsAreWhatMessagesDeliver) {
  core::ExpectedFronts expected;
  expected.horizon = 0.3;
  expected.fronts.resize(kSamples);
  for (core::ExpectedFront& front : expected.fronts) {
    front.stamp = stampOfToday();
    front.rectangle = rectangle();
    front.velocity = rectangle().center();
    front.angular_velocity = rectangle().center();
  }
  const core::ExpectedFronts sent = core::asSent(expected), delivered = fromMessage(toMessage(expected, header_));
  EXPECT_EQ(delivered.horizon, expected.horizon);
  ASSERT_EQ(delivered.fronts.size(), sent.fronts.size());
  for (size_t i = 0; i < sent.fronts.size(); ++i) {
    EXPECT_EQ(sent.fronts[i].stamp, delivered.fronts[i].stamp);
    expectSame(sent.fronts[i].rectangle, delivered.fronts[i].rectangle);
    EXPECT_EQ(sent.fronts[i].velocity, delivered.fronts[i].velocity);
    EXPECT_EQ(sent.fronts[i].angular_velocity, delivered.fronts[i].angular_velocity);
  }
}

TEST_F(AsSent, TrackUpdatesAreWhatMessagesDeliver) {
  std::vector<core::TrackUpdate> updates(2);
  updates[1].first = 12;
  std::uint32_t id = 0;
  for (core::TrackUpdate& update : updates) {
    update.track.id = ++id;
    update.track.revision = 3;
    update.track.width = rectangle().width;
    update.track.height = rectangle().height;
    update.track.observations.resize(kSamples);
    for (core::TrackedObservation& observation : update.track.observations)
      observation = {stampOfToday(), rectangle(), covariance(), {0.1F, 0.7F, 1, 0}, rectangle(), covariance()};
  }
  const auto sent = core::asSent(updates), delivered = fromMessage(toMessage(updates, header_));
  ASSERT_EQ(delivered.size(), sent.size());
  for (size_t k = 0; k < sent.size(); ++k) {
    EXPECT_EQ(sent[k].first, delivered[k].first);
    EXPECT_EQ(sent[k].track.id, delivered[k].track.id);
    EXPECT_EQ(sent[k].track.revision, delivered[k].track.revision);
    EXPECT_EQ(sent[k].track.width, delivered[k].track.width);
    EXPECT_EQ(sent[k].track.height, delivered[k].track.height);
    ASSERT_EQ(sent[k].track.observations.size(), delivered[k].track.observations.size());
    for (size_t i = 0; i < sent[k].track.observations.size(); ++i) {
      const core::TrackedObservation& a = sent[k].track.observations[i];
      const core::TrackedObservation& b = delivered[k].track.observations[i];
      EXPECT_EQ(a.stamp, b.stamp);
      expectSame(a.rectangle, b.rectangle);
      EXPECT_EQ(a.covariance, b.covariance);
      EXPECT_EQ(a.edge_support, b.edge_support);
      expectSame(a.measured, b.measured);
      EXPECT_EQ(a.measured_covariance, b.measured_covariance);
    }
  }
}

}  // namespace
}  // namespace cabinet_articulation
