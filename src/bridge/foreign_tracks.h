// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <articulation_msgs/TrackMsg.h>
#include <ros/ros.h>

#include "cabinet_articulation/articulation/articulation_config.h"

namespace cabinet_articulation::bridge {

/// Learns from each message on `track`, of trackers of the original release, and publishes the most probable model on `model`, as
/// its model learner did. Nothing is remembered from one message to the next.
class ForeignTracks {
 public:
  ForeignTracks(ros::NodeHandle nh, const core::ArticulationConfig& config);

 private:
  void learn(const articulation_msgs::TrackMsg& track);

  core::ArticulationConfig config_;
  ros::Publisher model_;
  ros::Subscriber track_;
};

}  // namespace cabinet_articulation::bridge
