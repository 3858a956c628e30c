// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "cabinet_articulation/tracking/track.h"
#include "tracking/size/front_size.h"

namespace cabinet_articulation::core {

/// What is remembered of a track beside its observations. Thinning the history does not touch it.
struct TrackMemory {
  static constexpr double kUnknown = 1e9;  ///< [m] standard deviation of what was never seen
  static constexpr double kLongAgo = -std::numeric_limits<double>::infinity();
  FrontSize size;
  double last_seen = kLongAgo;  ///< [s] in the time of the frames that come now, which may have been set back since
  int seen = 1;                 ///< frames
  int frames = 1;               ///< since the first one; of a long absence only the first few
  int unseen = 0;               ///< frames since the last one
  Eigen::Vector2d placed_sigma = Eigen::Vector2d::Constant(kUnknown);  ///< [m] of the size when the history was placed last
};

/// What the observations of a track tell of it, as if it was last seen long ago.
TrackMemory memoryOf(const Track& track, const TrackingConfig& config);

/// Tracks ordered by id, and the memory of each.
struct RememberedTracks {
  std::vector<Track> tracks;
  std::vector<TrackMemory> memories;  ///< parallel to tracks

  void insert(Track track, TrackMemory memory);
  bool erase(std::uint32_t id);
  bool contains(std::uint32_t id) const;
  void sort();
  void clear();
};

/// For every rectangle of a frame the index of the track that it continues, or -1: the best assignment of the frame as a
/// whole (least total cost; costs grow with the logarithm of the distance, so that one good pair and a new track beat two
/// doubtful pairs).
std::vector<int> assignToTracks(const std::vector<DetectedRectangle>& rectangles, const RememberedTracks& remembered,
                                double stamp, const TrackingConfig& config);

/// Has it been seen often enough to be more than clutter?
bool isConfirmed(const Track& track, const TrackingConfig& config);

}  // namespace cabinet_articulation::core
