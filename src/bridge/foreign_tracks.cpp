// SPDX-License-Identifier: BSD-3-Clause
#include "bridge/foreign_tracks.h"

#include <articulation_msgs/ModelMsg.h>

#include <exception>

#include "bridge/original_learner.h"

namespace cabinet_articulation::bridge {
namespace {

constexpr int kTracks = 16;  ///< [messages] that wait, one for each track of a frame; older ones are lost (ours)

}  // namespace

ForeignTracks::ForeignTracks(ros::NodeHandle nh, const core::ArticulationConfig& config)
    : config_(config),
      model_(nh.advertise<articulation_msgs::ModelMsg>("model", kTracks)),
      track_(nh.subscribe("track", kTracks, &ForeignTracks::learn, this)) {}

void ForeignTracks::learn(const articulation_msgs::TrackMsg& track) try {
  articulation_msgs::ModelMsg model;
  model.id = track.id;
  model.track = track;
  fitTo(config_, &model);
  model_.publish(model);
} catch (const std::exception& error) {
  ROS_ERROR_THROTTLE(5, "track: %s", error.what());
}

}  // namespace cabinet_articulation::bridge
