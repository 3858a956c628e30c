// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/config/config.h"
#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

struct TrackingConfig {
  double timeout = 20;  ///< [s] original release

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("timeout", self.timeout, Range{0.1, 1e6}, "s", "a track that was not seen for this long ends (original release: 20)");
  }
};

/// Paper III-C: joins the rectangles of successive frames into tracks.
class RectangleTracker {
 public:
  explicit RectangleTracker(const TrackingConfig& config);

  /// One frame: rectangles in the fixed frame, seen at `stamp` [s]. Returns the live tracks, ordered by id; the
  /// reference is valid until the next call. A stamp that is not newer than the last frame's is ignored (the tracks are
  /// returned unchanged); a clock that jumped back is the caller's business: see reset().
  const std::vector<Track>& process(double stamp, const std::vector<DetectedRectangle>& rectangles);

  const std::vector<Track>& tracks() const { return tracks_; }

  /// Where each live track is expected now, for the detector's track-guided fit.
  std::vector<Rectangle> expected() const;

  /// Forgets all tracks; ids go on counting, so that an id never means two fronts.
  void reset();

 private:
  TrackingConfig config_;
  std::vector<Track> tracks_;
};

}  // namespace cabinet_articulation::core
