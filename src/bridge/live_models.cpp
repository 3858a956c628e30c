// SPDX-License-Identifier: BSD-3-Clause
#include "bridge/live_models.h"

#include <articulation_msgs/ModelMsg.h>
#include <articulation_msgs/TrackMsg.h>

#include <algorithm>
#include <stdexcept>

#include "bridge/original_model.h"
#include "cabinet_articulation/ros/conversions.h"

namespace cabinet_articulation::bridge {
namespace {

constexpr int kFrames = 4;      ///< [messages] to be read; older ones are lost (ours)
constexpr int kFrontsOut = 64;  ///< [messages] one for each front of a frame (ours)

}  // namespace

LiveModels::LiveModels(ros::NodeHandle nh)
    : track_(nh.advertise<articulation_msgs::TrackMsg>("track", kFrontsOut)),
      model_(nh.advertise<articulation_msgs::ModelMsg>("model", kFrontsOut)),
      tracks_(nh.subscribe("tracks", kFrames, &LiveModels::takeTracks, this)),
      models_(nh.subscribe("models", kFrames, &LiveModels::takeModels, this)) {}

void LiveModels::takeTracks(const TrackArray& message) try {
  fronts_.add(fromMessage(message));
  if (track_.getNumSubscribers() == 0) return;
  for (const core::Track& track : fronts_.tracks()) track_.publish(toOriginal(track, message.header.frame_id));
} catch (const std::invalid_argument& error) {
  ROS_ERROR_THROTTLE(5, "tracks: %s", error.what());
}

void LiveModels::takeModels(const ArticulationModelArray& message) try {
  if (model_.getNumSubscribers() == 0) return;
  for (const core::LearnedModel& model : fromMessage(message)) {
    const auto is_its = [&](const core::Track& track) { return track.id == model.id; };
    const auto track = std::find_if(fronts_.tracks().begin(), fronts_.tracks().end(), is_its);
    if (track == fronts_.tracks().end()) continue;
    articulation_msgs::ModelMsg out;
    out.track = toOriginal(*track, message.header.frame_id);
    out.header = out.track.header;
    out.id = out.track.id;
    const OriginalTrack original = fromOriginal(out.track);
    describe(model, original.T_pose_center, &out);
    evaluate(model, original, {}, &out);
    resample(model, original.T_pose_center, &out);
    model_.publish(out);
  }
} catch (const std::exception& error) {
  ROS_ERROR_THROTTLE(5, "models: %s", error.what());
}

}  // namespace cabinet_articulation::bridge
