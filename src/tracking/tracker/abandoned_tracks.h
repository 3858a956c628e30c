// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "cabinet_articulation/tracking/track.h"
#include "cabinet_articulation/tracking/tracking_config.h"

namespace cabinet_articulation::core {

/// Ids of tracks that ended before they were confirmed, or that flickered. What is seen at such a place again is a new track
/// (its revision is the next), but has the id: clutter that comes and goes takes one id a place. At most
/// max_ended_tracks places; the oldest is forgotten first.
class AbandonedTracks {
 public:
  struct Entry {
    std::uint32_t id = 0;
    std::uint32_t revision = 0;
    Rectangle rectangle;  ///< as last seen
  };

  explicit AbandonedTracks(const TrackingConfig& config) : config_(config) {}

  void add(const Track& track);

  /// The entry in the place of `rectangle` (overlapInOnePlace) that overlaps it most and is kept no longer, or nothing.
  std::optional<Entry> take(const Rectangle& rectangle);

  bool forget(std::uint32_t id);
  bool contains(std::uint32_t id) const;
  void clear() { entries_.clear(); }

 private:
  TrackingConfig config_;
  std::deque<Entry> entries_;  ///< oldest first
};

}  // namespace cabinet_articulation::core
