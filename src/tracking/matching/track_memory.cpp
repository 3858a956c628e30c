// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/matching/track_memory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tracking/matching/assignment.h"
#include "tracking/matching/continuation.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kUsualDistance = 0.02;      ///< [m] of a detection from its track
constexpr double kNewTrackDistance = 0.2;    ///< [m] a rectangle farther from every track rather is a new front
constexpr double kTentativeDistance = 0.03;  ///< [m] of two tracks equally near, the confirmed one is right

double cost(double distance) { return std::log1p(std::pow(distance / kUsualDistance, 2)); }

}  // namespace

TrackMemory memoryOf(const Track& track, const TrackingConfig& config) {
  TrackMemory memory{FrontSize(config)};
  for (const TrackedObservation& observation : track.observations) {
    DetectedRectangle detection;
    detection.rectangle = observation.measured;
    detection.edge_support = observation.edge_support;
    memory.size.add(detection);
  }
  memory.seen = memory.frames = static_cast<int>(track.observations.size());
  return memory;
}

void RememberedTracks::insert(Track track, TrackMemory memory) {
  const auto later = [](const Track& a, const Track& b) { return a.id < b.id; };
  const auto place = std::upper_bound(tracks.begin(), tracks.end(), track, later);
  memories.insert(memories.begin() + (place - tracks.begin()), std::move(memory));
  tracks.insert(place, std::move(track));
}

bool RememberedTracks::erase(std::uint32_t id) {
  for (size_t i = 0; i < tracks.size(); ++i) {
    if (tracks[i].id != id) continue;
    tracks.erase(tracks.begin() + i);
    memories.erase(memories.begin() + i);
    return true;
  }
  return false;
}

bool RememberedTracks::contains(std::uint32_t id) const {
  return std::any_of(tracks.begin(), tracks.end(), [id](const Track& track) { return track.id == id; });
}

void RememberedTracks::sort() {
  RememberedTracks sorted;
  for (size_t i = 0; i < tracks.size(); ++i) sorted.insert(std::move(tracks[i]), std::move(memories[i]));
  *this = std::move(sorted);
}

void RememberedTracks::clear() {
  tracks.clear();
  memories.clear();
}

bool isConfirmed(const Track& track, const TrackingConfig& config) {
  return track.observations.size() >= static_cast<size_t>(config.confirmed_after);
}

std::vector<int> assignToTracks(const std::vector<DetectedRectangle>& rectangles, const RememberedTracks& remembered,
                                double stamp, const TrackingConfig& config) {
  constexpr double kForbidden = std::numeric_limits<double>::infinity();
  Eigen::MatrixXd costs(rectangles.size(), remembered.tracks.size());
  for (size_t i = 0; i < rectangles.size(); ++i) {
    for (size_t j = 0; j < remembered.tracks.size(); ++j) {
      const Track& track = remembered.tracks[j];
      const auto found = findContinuation(track, remembered.memories[j], rectangles[i], stamp, config);
      costs(i, j) = found ? cost(found->distance + (isConfirmed(track, config) ? 0 : kTentativeDistance)) : kForbidden;
    }
  }
  return assignRows(costs, cost(kNewTrackDistance));
}

}  // namespace cabinet_articulation::core
