// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "tracking/matching/track_memory.h"

namespace cabinet_articulation::core {

/// Moves the times of a history so that it ends `gap` [s] before `stamp`, or half-way from 0 to there if that is later. None
/// gets below 0, for no robot's messages hold that: a history that is too long is compressed. The order stays.
void placeBefore(std::vector<TrackedObservation>& history, double stamp, double gap);

/// Fronts that were not seen for so long that their tracks ended, kept so that they get their id and their history back
/// when they return: where they have been before, or opened further by a pull or a swing (findContinuation). At most
/// max_ended_tracks of them, each with a thinned history; those that moved least are forgotten first.
class EndedTracks {
 public:
  using Entry = std::pair<Track, TrackMemory>;

  explicit EndedTracks(const TrackingConfig& config) : config_(config) {}

  void keep(Track track, TrackMemory memory);

  /// For every rectangle the track that it continues, which is kept no longer, or nothing. Its observations are all before
  /// `stamp`, also if the clock was set back meanwhile.
  std::vector<std::optional<Entry>> takeBack(const std::vector<DetectedRectangle>& rectangles, double stamp);

  bool forget(std::uint32_t id) { return ended_.erase(id); }
  bool contains(std::uint32_t id) const { return ended_.contains(id); }
  const std::vector<Track>& tracks() const { return ended_.tracks; }
  void clear() { ended_.clear(); }

 private:
  TrackingConfig config_;
  RememberedTracks ended_;
};

}  // namespace cabinet_articulation::core
