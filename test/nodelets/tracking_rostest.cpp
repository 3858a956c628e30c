// SPDX-License-Identifier: BSD-3-Clause
#include <cabinet_articulation/KnownFrontArray.h>
#include <cabinet_articulation/RectangleArray.h>
#include <cabinet_articulation/TrackArray.h>
#include <gtest/gtest.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/transform_broadcaster.h>

#include "cabinet_articulation/ros/conversions.h"
#include "support/ros_probe.h"

namespace cabinet_articulation {
namespace {

using test::Recorder;
using test::spinUntil;

/// A camera that moves about in front of a front that rests.
class TrackingNodelet : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(spinUntil([&] { return tracks_.connected() && rectangles_.getNumSubscribers() > 0; }));
  }

  static core::DetectedRectangle front() {
    core::DetectedRectangle front;
    front.rectangle.pose =
        Eigen::Translation3d(2, 0.5, 0.8) * Eigen::Isometry3d(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
    front.rectangle.width = 0.4;
    front.rectangle.height = 0.6;
    front.covariance = core::Matrix6d::Identity() * 1e-6;
    front.precision = front.recall = 0.95;
    front.edge_support = {1, 1, 1, 1};
    return front;
  }

  /// Where the camera is `seconds` after the start of a test.
  static Eigen::Isometry3d cameraPose(double seconds) {
    return Eigen::Translation3d(0.3 * seconds, 0, 1) *
           Eigen::Isometry3d(Eigen::AngleAxisd(0.5 * seconds, Eigen::Vector3d::UnitY()));
  }

  void publishTransform(const std_msgs::Header& header, const Eigen::Isometry3d& T_map_camera) {
    geometry_msgs::TransformStamped transform = tf2::eigenToTransform(T_map_camera);
    transform.header.stamp = header.stamp;
    transform.header.frame_id = "map";
    transform.child_frame_id = header.frame_id;
    broadcaster_.sendTransform(transform);
  }

  void publishSeenFrom(const std_msgs::Header& header, const Eigen::Isometry3d& T_map_camera) {
    core::DetectedRectangle seen = front();
    seen.rectangle.pose = T_map_camera.inverse() * seen.rectangle.pose;
    rectangles_.publish(toMessage(std::vector<core::DetectedRectangle>{seen}, header));
  }

  void publishFrame(double seconds) {
    std_msgs::Header header;
    header.frame_id = "camera";
    header.stamp = start_ + ros::Duration(seconds);
    publishTransform(header, cameraPose(seconds));
    publishSeenFrom(header, cameraPose(seconds));
  }

  /// Frames at 10 Hz from `seconds` on, as fast as they are answered. The first ones may find no transform, for
  /// connecting to tf takes a while.
  void play(double seconds, int frames) {
    for (int i = 0; i < frames; ++i) {
      const size_t before = tracks_.messages.size();
      publishFrame(seconds + 0.1 * i);
      spinUntil([&] { return tracks_.messages.size() > before; }, 0.5);
    }
  }

  /// Plays until there is a track.
  TrackArray firstTracks(double seconds) {
    const size_t before = tracks_.messages.size();
    for (int i = 0; i < 40; ++i) {
      play(seconds + 0.1 * i, 1);
      if (tracks_.messages.size() > before && !tracks_.messages.back()->tracks.empty()) return *tracks_.messages.back();
    }
    return TrackArray();
  }

  // Each test plays at a later time than the one before, but for the test of the clock.
  static ros::Time nextStart() {
    static ros::Time start = ros::Time::now();
    return start += ros::Duration(100);
  }

  const ros::Time start_ = nextStart();
  ros::NodeHandle nh_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher rectangles_ = nh_.advertise<RectangleArray>("rectangles", 10);
  Recorder<TrackArray> tracks_{"tracks"};
  test::Reports reports_;
};

TEST_F(TrackingNodelet, SaysThatATransformIsMissing) {
  std_msgs::Header header;
  header.frame_id = "unknown_camera";
  EXPECT_TRUE(spinUntil([&] {
    header.stamp = ros::Time::now();
    publishSeenFrom(header, cameraPose(0));
    return spinUntil([&] { return reports_.statusHas("tracking", "no transform from 'unknown_camera' to 'map'"); }, 0.2);
  })) << reports_.status("tracking");
  EXPECT_TRUE(reports_.logged(rosgraph_msgs::Log::WARN, "no transform from 'unknown_camera' to 'map'"));
  EXPECT_EQ(firstTracks(0).tracks.size(), 1u) << "lives on";
}

TEST_F(TrackingNodelet, FrontRestsWhileTheCameraMoves) {
  play(0, 15);
  const TrackArray& message = *tracks_.messages.back();
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.header.stamp, start_ + ros::Duration(0.1 * 14));
  ASSERT_EQ(message.tracks.size(), 1u);
  core::TrackAssembly assembly;
  for (const auto& frame : tracks_.messages) assembly.add(fromMessage(*frame));
  const core::Track track = assembly.tracks().at(0);
  ASSERT_GE(track.observations.size(), 10u);
  for (const core::TrackedObservation& observation : track.observations)
    EXPECT_LT((observation.rectangle.center() - front().rectangle.center()).norm(), 1e-6);
  // The transform goes through tf's doubles; the size may be named either way round.
  EXPECT_NEAR(std::min(track.width, track.height), 0.4, 1e-3);
  EXPECT_NEAR(std::max(track.width, track.height), 0.6, 1e-3);
}

TEST_F(TrackingNodelet, TellsTheDetectorWhatToExpect) {
  const Recorder<ExpectedFrontArray> expected("expected_fronts");
  ASSERT_TRUE(spinUntil([&] { return expected.connected(); }));
  play(0, 15);
  ASSERT_TRUE(spinUntil([&] { return !expected.messages.empty() && !expected.messages.back()->fronts.empty(); }));
  EXPECT_EQ(expected.messages.back()->header.frame_id, "map");
  const core::ExpectedFront hint = fromMessage(expected.messages.back()->fronts[0]);
  EXPECT_LT((hint.rectangle.center() - front().rectangle.center()).norm(), 0.005);
}

TEST_F(TrackingNodelet, StartsAfreshWhenTheClockIsSetBack) {
  const TrackArray before = firstTracks(0);
  ASSERT_EQ(before.tracks.size(), 1u);
  const TrackArray after = firstTracks(-50);
  ASSERT_EQ(after.tracks.size(), 1u);
  EXPECT_NE(after.tracks[0].id, before.tracks[0].id) << "an id never means two tracks";
  EXPECT_LT(after.tracks[0].stamps[0], start_);
  EXPECT_TRUE(spinUntil([&] { return reports_.logged(rosgraph_msgs::Log::WARN, "time jumped back; all tracks are forgotten"); }));
}

TEST_F(TrackingNodelet, GivesKnownFrontsTheirIdsAlsoAfterTheClockWasSetBack) {
  core::Track known;
  known.id = 4711;
  known.width = front().rectangle.width;
  known.height = front().rectangle.height;
  for (int i = 0; i < 10; ++i) {
    core::TrackedObservation observation;
    observation.stamp = 1000 + 0.1 * i;
    observation.rectangle = front().rectangle;
    observation.covariance = front().covariance;
    observation.measured = observation.rectangle;
    observation.measured_covariance = observation.covariance;
    known.observations.push_back(observation);
  }
  KnownFrontArray message;
  message.header.frame_id = "map";
  message.generation = 77;
  message.tracks.push_back(toMessage(known, "map"));
  ros::Publisher publisher = nh_.advertise<KnownFrontArray>("known_fronts", 1, true);
  publisher.publish(message);
  ASSERT_TRUE(spinUntil([&] { return publisher.getNumSubscribers() > 0; }));
  TrackArray tracks;
  ASSERT_TRUE(spinUntil([&] { return (tracks = firstTracks(10)).generation == 77; })) << "says whose fronts it knows";
  ASSERT_EQ(tracks.tracks.size(), 1u);
  EXPECT_EQ(tracks.tracks[0].id, 4711u);
  EXPECT_GT(tracks.tracks[0].poses.size(), 10u);
  const TrackArray later = firstTracks(-60);
  ASSERT_EQ(later.tracks.size(), 1u);
  EXPECT_EQ(later.tracks[0].id, 4711u);
  EXPECT_LT(later.tracks[0].stamps.back(), start_);
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "tracking_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
