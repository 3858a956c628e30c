// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/ros/conversions.h"

#include <algorithm>
#include <stdexcept>

#include "cabinet_articulation/articulation/model_registry.h"
#include "cabinet_articulation/ros/pose_conversions.h"

namespace cabinet_articulation {
namespace {

/// fromMessage for every element; an error says which element it was.
template <class Core, class Message>
std::vector<Core> fromMessages(const std::vector<Message>& messages, const char* name) {
  std::vector<Core> result;
  result.reserve(messages.size());
  for (const Message& message : messages) {
    try {
      result.push_back(fromMessage(message));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(name + ("[" + std::to_string(result.size()) + "]: ") + error.what());
    }
  }
  return result;
}

/// Lists that hold `count` values for each pose of a track; an optional list may also be empty.
void requireLength(const char* name, size_t length, size_t poses, size_t count, bool optional) {
  if (length == poses * count || (optional && length == 0)) return;
  throw std::invalid_argument(std::string(name) + " has " + std::to_string(length) + " elements, expected " +
                              std::to_string(poses * count) + " for " + std::to_string(poses) + " poses");
}

}  // namespace

Rectangle toMessage(const core::DetectedRectangle& rectangle) {
  Rectangle message;
  message.pose.pose = toMessage(rectangle.rectangle.pose);
  message.pose.covariance = toMessage(rectangle.covariance);
  message.width = rectangle.rectangle.width;
  message.height = rectangle.rectangle.height;
  message.precision = rectangle.precision;
  message.recall = rectangle.recall;
  std::copy(rectangle.edge_support.begin(), rectangle.edge_support.end(), message.edge_support.begin());
  message.plane = static_cast<std::uint32_t>(std::max(rectangle.region, 0));
  return message;
}

core::DetectedRectangle fromMessage(const Rectangle& message) {
  core::DetectedRectangle rectangle;
  rectangle.rectangle = {fromMessage(message.pose.pose), message.width, message.height};
  rectangle.covariance = fromMessage(message.pose.covariance);
  rectangle.precision = message.precision;
  rectangle.recall = message.recall;
  std::copy(message.edge_support.begin(), message.edge_support.end(), rectangle.edge_support.begin());
  rectangle.region = static_cast<int>(message.plane);
  return rectangle;
}

RectangleArray toMessage(const std::vector<core::DetectedRectangle>& rectangles, const std_msgs::Header& header) {
  RectangleArray message;
  message.header = header;
  message.rectangles.reserve(rectangles.size());
  for (const core::DetectedRectangle& rectangle : rectangles) message.rectangles.push_back(toMessage(rectangle));
  return message;
}

std::vector<core::DetectedRectangle> fromMessage(const RectangleArray& message) {
  return fromMessages<core::DetectedRectangle>(message.rectangles, "rectangles");
}

Track toMessage(const core::Track& track, const std::string& frame_id) {
  Track message;
  message.header.frame_id = frame_id;
  if (!track.observations.empty()) message.header.stamp = toStamp(track.observations.back().stamp);
  message.id = track.id;
  message.width = track.width;
  message.height = track.height;
  const size_t count = track.observations.size();
  message.stamps.reserve(count);
  message.poses.reserve(count);
  message.widths.reserve(count);
  message.heights.reserve(count);
  message.covariances.reserve(36 * count);
  message.edge_support.reserve(4 * count);
  for (const core::TrackedObservation& observation : track.observations) {
    message.stamps.push_back(toStamp(observation.stamp));
    message.poses.push_back(toMessage(observation.rectangle.pose));
    message.widths.push_back(observation.rectangle.width);
    message.heights.push_back(observation.rectangle.height);
    const auto covariance = toMessage(observation.covariance);
    message.covariances.insert(message.covariances.end(), covariance.begin(), covariance.end());
    message.edge_support.insert(message.edge_support.end(), observation.edge_support.begin(), observation.edge_support.end());
  }
  return message;
}

core::Track fromMessage(const Track& message) {
  const size_t count = message.poses.size();
  requireLength("stamps", message.stamps.size(), count, 1, false);
  requireLength("widths", message.widths.size(), count, 1, true);
  requireLength("heights", message.heights.size(), count, 1, true);
  requireLength("covariances", message.covariances.size(), count, 36, true);
  requireLength("edge_support", message.edge_support.size(), count, 4, true);
  core::Track track;
  track.id = message.id;
  track.width = message.width;
  track.height = message.height;
  const std::vector<Eigen::Isometry3d> poses = fromMessages<Eigen::Isometry3d>(message.poses, "poses");
  track.observations.resize(count);
  for (size_t i = 0; i < count; ++i) {
    core::TrackedObservation& observation = track.observations[i];
    observation.stamp = message.stamps[i].toSec();
    observation.rectangle.pose = poses[i];
    observation.rectangle.width = message.widths.empty() ? message.width : message.widths[i];
    observation.rectangle.height = message.heights.empty() ? message.height : message.heights[i];
    if (!message.covariances.empty())
      observation.covariance = Eigen::Map<const core::Matrix6d>(&message.covariances[36 * i]).transpose();
    if (!message.edge_support.empty()) std::copy_n(&message.edge_support[4 * i], 4, observation.edge_support.begin());
    // What was placed by the track's size is the best that is known of what was measured.
    observation.measured = observation.rectangle;
    observation.measured_covariance = observation.covariance;
  }
  return track;
}

TrackArray toMessage(const std::vector<core::Track>& tracks, const std_msgs::Header& header) {
  TrackArray message;
  message.header = header;
  message.tracks.reserve(tracks.size());
  for (const core::Track& track : tracks) message.tracks.push_back(toMessage(track, header.frame_id));
  return message;
}

std::vector<core::Track> fromMessage(const TrackArray& message) { return fromMessages<core::Track>(message.tracks, "tracks"); }

ArticulationModel toMessage(const core::LearnedModel& model, const std::string& frame_id) {
  ArticulationModel message;
  message.header.stamp = toStamp(model.stamp);
  message.header.frame_id = frame_id;
  message.id = model.id;
  message.type = static_cast<std::uint8_t>(model.type);
  message.probabilities = model.probabilities;
  message.moved = model.moved;
  message.explained = model.explained;
  message.origin = toMessage(model.origin);
  message.axis = toVector(model.axis);
  message.axis_point = toPoint(model.axis_point);
  message.radius = model.radius;
  message.q = model.q;
  message.q_min = model.q_min;
  message.q_max = model.q_max;
  message.q_min_is_end = model.q_min_is_end;
  message.q_max_is_end = model.q_max_is_end;
  for (const Eigen::Isometry3d& pose : model.curve) message.curve.push_back(toMessage(pose));
  message.width = model.width;
  message.height = model.height;
  message.covariance = toMessage(model.covariance);
  message.position_error = model.position_error;
  message.orientation_error = model.orientation_error;
  message.observations = static_cast<std::uint32_t>(std::max(model.observations, 0));
  for (const core::ModelParam& param : model.params) {
    Param entry;
    entry.name = param.name;
    entry.value = param.value;
    entry.type = static_cast<std::uint8_t>(param.kind);
    message.params.push_back(entry);
  }
  return message;
}

core::LearnedModel fromMessage(const ArticulationModel& message) {
  if (message.type >= core::modelRegistry().size())
    throw std::invalid_argument("type is " + std::to_string(message.type) + ", expected less than " +
                                std::to_string(core::modelRegistry().size()));
  core::LearnedModel model;
  model.id = message.id;
  model.stamp = message.header.stamp.toSec();
  model.type = static_cast<core::JointType>(message.type);
  model.probabilities = message.probabilities;
  model.moved = message.moved;
  model.explained = message.explained;
  model.origin = fromMessage(message.origin);
  model.axis = fromMessage(message.axis);
  model.axis_point = fromMessage(message.axis_point);
  model.radius = message.radius;
  model.q = message.q;
  model.q_min = message.q_min;
  model.q_max = message.q_max;
  model.q_min_is_end = message.q_min_is_end;
  model.q_max_is_end = message.q_max_is_end;
  for (const geometry_msgs::Pose& pose : message.curve) model.curve.push_back(fromMessage(pose));
  model.width = message.width;
  model.height = message.height;
  model.covariance = fromMessage(message.covariance);
  model.position_error = message.position_error;
  model.orientation_error = message.orientation_error;
  model.observations = static_cast<int>(message.observations);
  for (const Param& param : message.params)
    model.params.push_back({param.name, param.value, static_cast<core::ModelParam::Kind>(param.type)});
  return model;
}

ArticulationModelArray toMessage(const std::vector<core::LearnedModel>& models, const std_msgs::Header& header) {
  ArticulationModelArray message;
  message.header = header;
  message.models.reserve(models.size());
  for (const core::LearnedModel& model : models) message.models.push_back(toMessage(model, header.frame_id));
  return message;
}

std::vector<core::LearnedModel> fromMessage(const ArticulationModelArray& message) {
  return fromMessages<core::LearnedModel>(message.models, "models");
}

}  // namespace cabinet_articulation
