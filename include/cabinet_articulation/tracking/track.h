// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "cabinet_articulation/rectangles/detected_rectangle.h"

namespace cabinet_articulation::core {

/// One observation of a tracked front, in the track's corner choice and in the fixed frame.
struct TrackedObservation {
  double stamp = 0;                                 ///< [s]
  Rectangle rectangle;                              ///< observed edges as seen, the others by the track's size
  Matrix6d covariance = Matrix6d::Zero();           ///< of `rectangle`; axes as DetectedRectangle, fixed frame
  std::array<float, 4> edge_support{{1, 1, 1, 1}};  ///< in the track's corner choice
  Rectangle measured;                               ///< as detected, whatever edges were observed
  Matrix6d measured_covariance = Matrix6d::Zero();  ///< of `measured`
};

/// Ids of known fronts are 1 to this; 0 is nobody. The rest of 32 bits is room for the fronts that are found from there on.
constexpr std::uint32_t kLargestId = 4000000000U;

/// The history of one physical front (paper III-C), oldest observation first.
struct Track {
  std::uint32_t id = 0;
  double width = 0;     ///< [m] estimated over the whole track
  double height = 0;    ///< [m]
  bool hollow = false;  ///< was seen to be a frame around a hole
  /// Counts how often a better size placed earlier observations anew. While it stays the same, observations were appended
  /// or, never the first and the newest, thinned out.
  std::uint32_t revision = 0;
  std::vector<TrackedObservation> observations;
};

/// The track of this id, or null.
inline const Track* findTrack(std::uint32_t id, const std::vector<Track>& tracks) {
  const auto found = std::find_if(tracks.begin(), tracks.end(), [id](const Track& track) { return track.id == id; });
  return found == tracks.end() ? nullptr : &*found;
}

}  // namespace cabinet_articulation::core
