// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "ros/checks/from_messages.h"

namespace cabinet_articulation {
namespace {

/// Lists that hold `count` values for each pose of a track; an optional list may also be empty.
void requireLength(const std::string& name, size_t length, size_t poses, size_t count, bool optional) {
  if (length == poses * count || (optional && length == 0)) return;
  throw std::invalid_argument(name + " has " + std::to_string(length) + " elements, expected " + std::to_string(poses * count) +
                              " for " + std::to_string(poses) + " poses");
}

struct UncertainRectangle {
  core::Rectangle rectangle;
  core::Matrix6d covariance = core::Matrix6d::Zero();
};

/// The lists of a track message that hold a rectangle for each observation, as it was placed and as it was measured.
template <class TrackMessage>
auto placedLists(TrackMessage& message) {
  return std::tie(message.poses, message.widths, message.heights, message.covariances);
}

template <class TrackMessage>
auto measuredLists(TrackMessage& message) {
  return std::tie(message.measured_poses, message.measured_widths, message.measured_heights, message.measured_covariances);
}

template <class Lists>
void reserve(size_t count, const Lists& lists) {
  const auto& [poses, widths, heights, covariances] = lists;
  poses.reserve(count);
  widths.reserve(count);
  heights.reserve(count);
  covariances.reserve(36 * count);
}

template <class Lists>
void append(const UncertainRectangle& rectangle, const Lists& lists) {
  const auto& [poses, widths, heights, covariances] = lists;
  poses.push_back(toMessage(rectangle.rectangle.pose));
  widths.push_back(rectangle.rectangle.width);
  heights.push_back(rectangle.rectangle.height);
  const auto covariance = toMessage(rectangle.covariance);
  covariances.insert(covariances.end(), covariance.begin(), covariance.end());
}

/// What a list does not hold stays as it is.
template <class Lists>
void read(const Lists& lists, const std::string& prefix, std::vector<UncertainRectangle>* rectangles) {
  const auto& [poses, widths, heights, covariances] = lists;
  const size_t count = rectangles->size();
  requireLength(prefix + "poses", poses.size(), count, 1, true);
  requireLength(prefix + "widths", widths.size(), count, 1, true);
  requireLength(prefix + "heights", heights.size(), count, 1, true);
  requireLength(prefix + "covariances", covariances.size(), count, 36, true);
  const auto decoded = fromMessages<Eigen::Isometry3d>(poses, prefix + "poses", core::limits::kMostEntries);
  for (size_t i = 0; i < count; ++i) {
    auto& [rectangle, covariance] = (*rectangles)[i];
    if (!decoded.empty()) rectangle.pose = decoded[i];
    if (!widths.empty()) rectangle.width = widths[i];
    if (!heights.empty()) rectangle.height = heights[i];
    if (!covariances.empty()) covariance = Eigen::Map<const core::Matrix6d>(&covariances[36 * i]).transpose();
  }
}

template <class Element>
TrackArray toTrackArray(const std::vector<Element>& tracks, const std_msgs::Header& header) {
  TrackArray message;
  message.header = header;
  message.tracks.reserve(tracks.size());
  for (const Element& track : tracks) message.tracks.push_back(toMessage(track, header.frame_id));
  return message;
}

/// Numbers alone, not whether the lists agree.
void requireSane(const Track& message) {
  core::requireSideOrUnknown("width", message.width);
  core::requireSideOrUnknown("height", message.height);
  for (const ros::Time& stamp : message.stamps) requireStamp("stamps", stamp);
  for (const double width : message.widths) core::requireSideOrUnknown("widths", width);
  for (const double height : message.heights) core::requireSideOrUnknown("heights", height);
  for (const double width : message.measured_widths) core::requireSideOrUnknown("measured_widths", width);
  for (const double height : message.measured_heights) core::requireSideOrUnknown("measured_heights", height);
  for (const double value : message.covariances) core::requireWithin("covariances", value, core::limits::kVariance);
  for (const double value : message.measured_covariances)
    core::requireWithin("measured_covariances", value, core::limits::kVariance);
  for (const float support : message.edge_support) core::requireWithin("edge_support", support, core::limits::kShare);
}

}  // namespace

Track toMessage(const core::Track& track, const std::string& frame_id) {
  Track message;
  message.header.frame_id = frame_id;
  if (!track.observations.empty()) message.header.stamp = toStamp(track.observations.back().stamp);
  message.id = track.id;
  message.revision = track.revision;
  message.width = track.width;
  message.height = track.height;
  message.hollow = track.hollow;
  const size_t count = track.observations.size();
  message.stamps.reserve(count);
  message.edge_support.reserve(4 * count);
  reserve(count, placedLists(message));
  reserve(count, measuredLists(message));
  for (const core::TrackedObservation& observation : track.observations) {
    message.stamps.push_back(toStamp(observation.stamp));
    message.edge_support.insert(message.edge_support.end(), observation.edge_support.begin(), observation.edge_support.end());
    append({observation.rectangle, observation.covariance}, placedLists(message));
    append({observation.measured, observation.measured_covariance}, measuredLists(message));
  }
  return message;
}

Track toMessage(const core::TrackUpdate& update, const std::string& frame_id) {
  Track message = toMessage(update.track, frame_id);
  message.first = static_cast<std::uint32_t>(update.first);
  return message;
}

core::TrackUpdate fromMessage(const Track& message) {
  const size_t count = message.poses.size();
  core::requireAtMost("poses", count, core::limits::kMostEntries);
  requireLength("stamps", message.stamps.size(), count, 1, false);
  requireLength("edge_support", message.edge_support.size(), count, 4, true);
  requireSane(message);
  core::TrackUpdate update;
  update.first = message.first;
  update.track.id = message.id;
  update.track.revision = message.revision;
  update.track.width = message.width;
  update.track.height = message.height;
  update.track.hollow = message.hollow;
  std::vector<UncertainRectangle> placed(count);
  for (UncertainRectangle& each : placed) each.rectangle = {Eigen::Isometry3d::Identity(), message.width, message.height};
  read(placedLists(message), "", &placed);
  // What was placed by the track's size is the best that is known of what was measured.
  std::vector<UncertainRectangle> measured = placed;
  read(measuredLists(message), "measured_", &measured);
  update.track.observations.resize(count);
  for (size_t i = 0; i < count; ++i) {
    core::TrackedObservation& observation = update.track.observations[i];
    observation.stamp = message.stamps[i].toSec();
    observation.rectangle = placed[i].rectangle;
    observation.covariance = placed[i].covariance;
    observation.measured = measured[i].rectangle;
    observation.measured_covariance = measured[i].covariance;
    if (!message.edge_support.empty()) std::copy_n(&message.edge_support[4 * i], 4, observation.edge_support.begin());
  }
  return update;
}

core::Track wholeTrack(const Track& message) {
  if (message.first != 0)
    throw std::invalid_argument("first is " + std::to_string(message.first) + ", expected 0: a whole track");
  return fromMessage(message).track;
}

std::vector<core::Track> usableTracks(const KnownFrontArray& message, std::string* left_out) {
  return convertUsable<core::Track>(message.tracks, "tracks", core::limits::kMostEntries, wholeTrack, left_out);
}

TrackArray toMessage(const std::vector<core::Track>& tracks, const std_msgs::Header& header) {
  return toTrackArray(tracks, header);
}

TrackArray toMessage(const std::vector<core::TrackUpdate>& updates, const std_msgs::Header& header) {
  return toTrackArray(updates, header);
}

std::vector<core::TrackUpdate> fromMessage(const TrackArray& message) {
  std::vector<core::TrackUpdate> updates = fromMessages<core::TrackUpdate>(message.tracks, "tracks", core::limits::kMostFronts);
  std::set<std::uint32_t> ids;
  for (size_t i = 0; i < updates.size(); ++i) {
    const core::Track& track = updates[i].track;
    std::string wrong;
    if (track.id == 0)
      wrong = "id is 0, expected 1 or more";
    else if (!ids.insert(track.id).second)
      wrong = "id " + std::to_string(track.id) + " is there twice";
    else if (track.observations.empty())
      wrong = "no poses, expected at least the newest one";
    if (!wrong.empty()) throw std::invalid_argument("tracks[" + std::to_string(i) + "]: " + wrong);
  }
  return updates;
}

ExpectedFrontArray toMessage(const core::ExpectedFronts& expected, const std_msgs::Header& header) {
  ExpectedFrontArray message;
  message.header = header;
  message.horizon = expected.horizon;
  for (const core::ExpectedFront& front : expected.fronts) {
    ExpectedFront entry;
    entry.stamp = toStamp(front.stamp);
    entry.pose = toMessage(front.rectangle.pose);
    entry.width = front.rectangle.width;
    entry.height = front.rectangle.height;
    entry.velocity = toVector(front.velocity);
    entry.angular_velocity = toVector(front.angular_velocity);
    message.fronts.push_back(entry);
  }
  return message;
}

core::ExpectedFront fromMessage(const ExpectedFront& message) {
  core::ExpectedFront front;
  front.stamp = message.stamp.toSec();
  front.rectangle = {fromMessage(message.pose), message.width, message.height};
  front.velocity = fromMessage(message.velocity);
  front.angular_velocity = fromMessage(message.angular_velocity);
  requireStamp("stamp", message.stamp);
  core::requireSideOrUnknown("width", message.width);
  core::requireSideOrUnknown("height", message.height);
  core::requireWithin("length of velocity", front.velocity.norm(), core::limits::kSpeed);
  core::requireWithin("length of angular_velocity", front.angular_velocity.norm(), core::limits::kTurnRate);
  return front;
}

core::ExpectedFronts fromMessage(const ExpectedFrontArray& message) {
  core::ExpectedFronts expected;
  expected.horizon = message.horizon;
  core::requireWithin("horizon", expected.horizon, core::limits::kHorizon);
  expected.fronts = fromMessages<core::ExpectedFront>(message.fronts, "fronts", core::limits::kMostFronts);
  return expected;
}

}  // namespace cabinet_articulation
