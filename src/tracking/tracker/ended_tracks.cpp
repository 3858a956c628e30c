// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracker/ended_tracks.h"

#include <algorithm>

#include "geometry/message_precision.h"
#include "tracking/motion/history.h"
#include "tracking/motion/motion_gate.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kKept = 64;  ///< observations: a centimetre apart on the longest drawer

/// [m] How far the front has been from where it was first seen.
double extent(const Track& track) {
  double farthest = 0;
  for (const TrackedObservation& observation : track.observations)
    farthest = std::max(farthest, cornerDistance(track.observations.front().rectangle, observation.rectangle));
  return farthest;
}

}  // namespace

void placeBefore(std::vector<TrackedObservation>& history, double stamp, double gap) {
  const double first = history.front().stamp, last = history.back().stamp;
  const double start = std::min(0.0, stamp);
  const double end = stamp > 0 ? std::max(stamp - gap, stamp / 2) : stamp;
  const double scale = last > first ? std::min(1.0, (end - start) / (last - first)) : 1;
  for (TrackedObservation& observation : history) {
    const double moved = std::max(start, end - (last - observation.stamp) * scale);
    // A time that a message holds to the bit.
    observation.stamp = moved > 0 ? asSent(moved) : moved;
  }
}

void EndedTracks::keep(Track track, TrackMemory memory) {
  while (thinOut(track.observations, kKept)) continue;
  ended_.insert(std::move(track), std::move(memory));
  if (ended_.tracks.size() <= static_cast<size_t>(config_.max_ended_tracks)) return;
  const auto least = std::min_element(ended_.tracks.begin(), ended_.tracks.end(),
                                      [](const Track& a, const Track& b) { return extent(a) < extent(b); });
  ended_.memories.erase(ended_.memories.begin() + (least - ended_.tracks.begin()));
  ended_.tracks.erase(least);
}

std::vector<std::optional<EndedTracks::Entry>> EndedTracks::takeBack(const std::vector<DetectedRectangle>& rectangles,
                                                                     double stamp) {
  std::vector<std::optional<Entry>> taken(rectangles.size());
  if (rectangles.empty() || ended_.tracks.empty()) return taken;
  const std::vector<int> track_of = assignToTracks(rectangles, ended_, stamp, config_);
  std::vector<bool> gone(ended_.tracks.size(), false);
  for (size_t i = 0; i < rectangles.size(); ++i) {
    if (track_of[i] < 0) continue;
    taken[i].emplace(std::move(ended_.tracks[track_of[i]]), std::move(ended_.memories[track_of[i]]));
    gone[track_of[i]] = true;
    Track& track = taken[i]->first;
    if (track.observations.back().stamp >= stamp) {
      placeBefore(track.observations, stamp, config_.timeout);
      ++track.revision;
    }
  }
  RememberedTracks left;
  for (size_t j = 0; j < gone.size(); ++j)
    if (!gone[j]) left.insert(std::move(ended_.tracks[j]), std::move(ended_.memories[j]));
  ended_ = std::move(left);
  return taken;
}

}  // namespace cabinet_articulation::core
