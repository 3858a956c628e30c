// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/ArticulationModelArray.h>
#include <cabinet_articulation/TrackArray.h>
#include <gtest/gtest.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "cabinet_articulation/ros/conversions.h"
#include "support/ros_probe.h"

namespace cabinet_articulation {
namespace test {

constexpr int kFrames = 60, kAtRest = 15;
inline const Eigen::Vector3d kHinge(-0.3, 0.1, 1.5);

/// The front of a door 0.4 m wide with a vertical hinge (y is down), closed facing the camera.
inline Eigen::Isometry3d doorPose(double q) {
  return Eigen::Translation3d(kHinge) * Eigen::AngleAxisd(q, Eigen::Vector3d::UnitY()) * Eigen::Translation3d(0.2, 0, 0) *
         Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX());
}

/// A drawer that comes out towards the camera.
inline Eigen::Isometry3d drawerPose(double q) {
  return Eigen::Translation3d(0.5, 0.3, 1.5 - q) * Eigen::Isometry3d(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
}

inline Eigen::Isometry3d wallPose(double) {
  return Eigen::Translation3d(0.5, -0.5, 2) * Eigen::Isometry3d(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
}

/// Feeds the articulation nodelet in the namespace `ns` with tracks of a door, a drawer and a wall that grow frame by frame,
/// with a millimetre of noise.
class MovingFronts : public testing::Test {
 protected:
  explicit MovingFronts(const std::string& ns) : nh_(ns), models_(nh_.resolveName("models")) {}

  void SetUp() override {
    tracks_.resize(3);
    for (size_t i = 0; i < 3; ++i) {
      tracks_[i].id = nextId();
      tracks_[i].width = 0.4;
      tracks_[i].height = i == 1 ? 0.2 : 0.6;
    }
    ASSERT_TRUE(spinUntil([&] { return models_.connected() && output_.getNumSubscribers() > 0; }));
  }

  /// The nodelet, in the manager `ns`/manager, of tests that load it themselves.
  void loadNodelet() {
    nodelet::NodeletLoad load;
    load.request.name = nh_.resolveName("articulation");
    load.request.type = "cabinet_articulation/articulation";
    const std::string service = nh_.resolveName("manager/load_nodelet");
    EXPECT_TRUE(ros::service::waitForService(service, ros::Duration(kGenerous)));
    EXPECT_TRUE(ros::service::call(service, load));
  }

  void unloadNodelet() {
    nodelet::NodeletUnload unload;
    unload.request.name = nh_.resolveName("articulation");
    ros::service::call(nh_.resolveName("manager/unload_nodelet"), unload);
  }

  void restart() {
    unloadNodelet();
    loadNodelet();
    ASSERT_TRUE(spinUntil([&] { return models_.connected() && output_.getNumSubscribers() > 0; }));
  }

  /// An id never means two tracks, not even in two tests.
  static std::uint32_t nextId() {
    static std::uint32_t id = 6;
    return ++id;
  }

  void observe(core::Track* track, const Eigen::Isometry3d& pose, double stamp) {
    core::TrackedObservation observation;
    observation.stamp = stamp;
    observation.rectangle = {pose, track->width, track->height};
    observation.rectangle.pose.translation() += 1e-3 * Eigen::Vector3d(noise_(random_), noise_(random_), noise_(random_));
    observation.covariance.diagonal() << 1e-6, 1e-6, 1e-6, 1e-4, 1e-4, 1e-4;
    track->observations.push_back(observation);
  }

  void send(double stamp) {
    std_msgs::Header header;
    header.stamp = ros::Time(stamp);
    header.frame_id = frame_id_;
    TrackArray message = toMessage(tracks_, header);
    message.generation = generation_;
    if (!view_.empty()) message.view = toMessage(view_);
    output_.publish(message);
  }

  /// Publishes the tracks as of `stamp` and returns the models.
  ArticulationModelArrayConstPtr publish(double stamp) {
    const size_t before = models_.messages.size();
    send(stamp);
    return spinUntil([&] { return models_.messages.size() > before; }) ? models_.messages.back() : nullptr;
  }

  /// Door and drawer rest for a second, as they do in life, and open; the models of the last frame.
  ArticulationModelArrayConstPtr play(double start) {
    ArticulationModelArrayConstPtr models;
    for (int i = 0; i < kFrames; ++i) {
      const double stamp = start + i / 15.0;
      const double opening = std::max(0.0, static_cast<double>(i - kAtRest) / (kFrames - 1 - kAtRest));
      observe(&tracks_[0], doorPose(1.4 * opening), stamp);
      observe(&tracks_[1], drawerPose(0.3 * opening), stamp);
      observe(&tracks_[2], wallPose(0), stamp);
      models = publish(stamp);
    }
    return models;
  }

  std::mt19937 random_{1};
  std::normal_distribution<double> noise_;
  std::vector<core::Track> tracks_;
  std::string frame_id_ = "map";
  std::uint32_t generation_ = 0;
  core::DepthView view_;  ///< sent along, unless it is empty
  ros::NodeHandle nh_;
  ros::Publisher output_ = nh_.advertise<TrackArray>("tracks", 10);
  Recorder<ArticulationModelArray> models_;
};

}  // namespace test
}  // namespace cabinet_articulation
