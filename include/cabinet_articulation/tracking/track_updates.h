// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/// The end of a track, or all of it.
struct TrackUpdate {
  Track track;            ///< observations from `first` on: the last one that went out before, and what is new
  std::size_t first = 0;  ///< index in the whole track; 0: the whole track
};

/// What of the tracks goes out after each frame, so that a frame costs the same however long its tracks are: what is new. A
/// track goes out as a whole when it is new and when earlier observations were placed anew or thinned out. Every few seconds it
/// does so, too, for those who missed something.
class TrackUpdates {
 public:
  static constexpr double kWholePeriod = 5;  ///< [s] by the stamps; at most one track of a frame is due (ours)

  /// One update for each of the tracks, in their order, after the frame of `stamp` [s]. To be called for every frame.
  std::vector<TrackUpdate> of(const std::vector<Track>& tracks, double stamp);

  /// Next time all tracks go out as a whole.
  void startAnew() { sent_.clear(); }

 private:
  struct Sent {
    std::uint32_t revision = 0;
    std::size_t count = 0;  ///< observations
    double newest = 0;      ///< [s] stamp of the last one
    double last_whole = 0;  ///< [s]
  };

  static bool continues(const Sent& sent, const Track& track);
  std::uint32_t mostOverdue(double stamp) const;

  std::map<std::uint32_t, Sent> sent_;
};

/// Puts tracks together from updates.
class TrackAssembly {
 public:
  /// One frame's updates. Returns the tracks that they name, in their order; valid until the next call. An update continues what
  /// is here if the revision is the same and its first observation is known, at that place and with that stamp. Else (one was
  /// missed) the track stays as it is until it comes as a whole.
  const std::vector<Track>& add(std::vector<TrackUpdate> updates);

  const std::vector<Track>& tracks() const { return tracks_; }

  /// Tracks that the last call of add() named no more.
  const std::vector<Track>& ended() const { return ended_; }

  /// Tracks of the last call that wait for a whole one.
  std::size_t waiting() const { return waiting_; }

  void clear() { *this = TrackAssembly(); }

 private:
  std::vector<Track> tracks_, ended_;
  std::size_t waiting_ = 0;
};

}  // namespace cabinet_articulation::core
