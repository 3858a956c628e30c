// SPDX-License-Identifier: BSD-3-Clause
#include "bridge/live_models.h"

#include <exception>

#include "bridge/original_model.h"
#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/joints/hanging.h"
#include "cabinet_articulation/ros/conversions.h"

namespace cabinet_articulation::bridge {
namespace {

using articulation_msgs::ModelMsg;

constexpr int kFrames = 4;  ///< [messages] to be read; older ones are lost (ours)
/// [messages] that wait to be sent: one for each front of the largest message.
constexpr auto kFrontsOut = static_cast<int>(core::limits::kMostFronts);

/// What is no joint, or merely expected to be one, rests where it is.
core::LearnedModel asLearned(core::LearnedModel model) {
  if (core::isJoint(model)) return model;
  model.origin = model.predict(model.q);
  model.type = core::JointType::kRigid;
  model.curve.clear();
  model.q = model.q_min = model.q_max = 0;
  return model;
}

ModelMsg modelOf(const core::LearnedModel& model, const core::Track& track, const std::string& frame_id) {
  ModelMsg message;
  message.track = toOriginal(track, frame_id);
  message.header = message.track.header;
  message.id = message.track.id;
  const OriginalTrack original = fromOriginal(message.track);
  describe(model, original.T_pose_center, &message);
  evaluate(model, original, {}, &message);
  resample(model, original.T_pose_center, &message);
  return message;
}

}  // namespace

std::vector<ModelMsg> originalModels(const ArticulationModelArray& models, const std::vector<core::Track>& tracks,
                                     std::string* left_out) {
  std::vector<ModelMsg> messages;
  for (const core::LearnedModel& model : core::allPlaced(usableModels(models, left_out))) {
    const core::Track* track = core::findTrack(model.id, tracks);
    if (track == nullptr) continue;
    try {
      messages.push_back(modelOf(asLearned(model), *track, models.header.frame_id));
    } catch (const std::exception& error) {
      *left_out = "front " + std::to_string(model.id) + ": " + error.what();
    }
  }
  return messages;
}

LiveModels::LiveModels(ros::NodeHandle nh)
    : track_(nh.advertise<articulation_msgs::TrackMsg>("track", kFrontsOut)),
      model_(nh.advertise<ModelMsg>("model", kFrontsOut)),
      tracks_(nh.subscribe("tracks", kFrames, &LiveModels::takeTracks, this)),
      models_(nh.subscribe("models", kFrames, &LiveModels::takeModels, this)) {}

void LiveModels::takeTracks(const TrackArray& message) try {
  fronts_.add(fromMessage(message));
  if (track_.getNumSubscribers() == 0) return;
  for (const core::Track& track : fronts_.tracks()) track_.publish(toOriginal(track, message.header.frame_id));
} catch (const std::exception& error) {
  ROS_ERROR_THROTTLE(5, "tracks: %s", error.what());
}

void LiveModels::takeModels(const ArticulationModelArray& message) try {
  if (model_.getNumSubscribers() == 0) return;
  std::string left_out;
  for (const ModelMsg& model : originalModels(message, fronts_.tracks(), &left_out)) model_.publish(model);
  if (!left_out.empty()) ROS_ERROR_THROTTLE(5, "models: %s; it is left out", left_out.c_str());
} catch (const std::exception& error) {
  ROS_ERROR_THROTTLE(5, "models: %s", error.what());
}

}  // namespace cabinet_articulation::bridge
