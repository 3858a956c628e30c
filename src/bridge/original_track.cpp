// SPDX-License-Identifier: BSD-3-Clause
#include "bridge/original_track.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/ros/pose_conversions.h"

namespace cabinet_articulation::bridge {
namespace {

using articulation_msgs::TrackMsg;

const std::vector<float>* findChannel(const std::string& name, const TrackMsg& message) {
  const auto& all = message.channels;
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& entry) { return entry.name == name; });
  if (found == all.end()) return nullptr;
  if (found->values.size() != message.pose.size())
    throw std::invalid_argument("channel '" + name + "' has " + std::to_string(found->values.size()) + " values for " +
                                std::to_string(message.pose.size()) + " poses");
  return &found->values;
}

double mean(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Eigen::Isometry3d centerFromCorner(double width, double height) {
  return Eigen::Isometry3d(Eigen::Translation3d(width / 2, height / 2, 0));
}

double stampOf(const TrackMsg& message, std::size_t i) {
  if (message.pose_headers.empty()) return static_cast<double>(i);
  requireStamp("pose_headers", message.pose_headers[i].stamp);
  return message.pose_headers[i].stamp.toSec();
}

Eigen::Isometry3d poseOf(const TrackMsg& message, std::size_t i) {
  try {
    return fromMessage(message.pose[i]);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("pose[" + std::to_string(i) + "]: " + error.what());
  }
}

}  // namespace

OriginalTrack fromOriginal(const TrackMsg& message) {
  if (message.pose.empty()) throw std::invalid_argument("the track has no poses");
  core::requireAtMost("poses", message.pose.size(), core::limits::kMostEntries);
  if (!message.pose_headers.empty() && message.pose_headers.size() != message.pose.size())
    throw std::invalid_argument("there are " + std::to_string(message.pose_headers.size()) + " pose_headers for " +
                                std::to_string(message.pose.size()) + " poses");
  const std::vector<float>* widths = findChannel("width", message);
  const std::vector<float>* heights = findChannel("height", message);
  const bool is_rectangle = widths && heights;
  OriginalTrack result;
  result.track.id = static_cast<std::uint32_t>(std::max(message.id, 0));
  for (std::size_t i = 0; i < message.pose.size(); ++i) {
    core::TrackedObservation observation;
    observation.stamp = stampOf(message, i);
    core::Rectangle& rectangle = observation.rectangle;
    rectangle.pose = poseOf(message, i);
    if (is_rectangle) {
      rectangle.width = (*widths)[i];
      rectangle.height = (*heights)[i];
      core::requireSideOrUnknown("width", rectangle.width);
      core::requireSideOrUnknown("height", rectangle.height);
      rectangle.pose = rectangle.pose * centerFromCorner(rectangle.width, rectangle.height);
    }
    observation.measured = rectangle;
    result.track.observations.push_back(observation);
  }
  if (!is_rectangle) return result;
  result.track.width = mean(*widths);
  result.track.height = mean(*heights);
  result.T_pose_center = centerFromCorner(result.track.width, result.track.height);
  return result;
}

TrackMsg toOriginal(const core::Track& track, const std::string& frame_id) {
  TrackMsg message;
  message.header.frame_id = frame_id;
  message.id = static_cast<std::int32_t>(track.id);
  for (const core::TrackedObservation& observation : track.observations) {
    const core::Rectangle& rectangle = observation.rectangle;
    message.pose.push_back(toMessage(rectangle.pose * centerFromCorner(rectangle.width, rectangle.height).inverse()));
    message.pose_headers.emplace_back();
    message.pose_headers.back().stamp = toStamp(observation.stamp);
    message.pose_headers.back().frame_id = frame_id;
  }
  if (track.observations.empty()) return message;
  message.header.stamp = message.pose_headers.back().stamp;
  if (track.width <= 0 || track.height <= 0) return message;
  for (std::size_t i = 0; i < track.observations.size(); ++i) {
    channel("width", &message)[i] = static_cast<float>(track.observations[i].rectangle.width);
    channel("height", &message)[i] = static_cast<float>(track.observations[i].rectangle.height);
  }
  return message;
}

std::vector<float>& channel(const std::string& name, TrackMsg* track) {
  auto& all = track->channels;
  auto found = std::find_if(all.begin(), all.end(), [&](const auto& entry) { return entry.name == name; });
  if (found == all.end()) {
    found = all.emplace(all.end());
    found->name = name;
  }
  found->values.resize(track->pose.size());
  return found->values;
}

}  // namespace cabinet_articulation::bridge
