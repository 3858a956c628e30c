// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "cabinet_articulation/tracking/expected_fronts.h"
#include "cabinet_articulation/tracking/tracking_config.h"

namespace cabinet_articulation::core {

class AbandonedTracks;
class EndedTracks;
struct RememberedTracks;
struct TrackMemory;

/// Paper III-C: joins the rectangles of successive frames into tracks, one per physical front.
///
/// A frame's rectangles are assigned as a whole (least total distance), each in that one of its eight descriptions that
/// continues the track. Size and place come from observed edges only. A front that disappears (closed fronts are
/// coplanar with their neighbours and cannot be seen) keeps its track for `timeout`, and gets it back where it was last
/// seen, where a pull or a swing can have brought it meanwhile, or anywhere along the track's history. After the timeout
/// the track ends, but the front gets its id and history back if it returns in one of these ways (EndedTracks). Clutter that
/// is seen now and then has one id a place (AbandonedTracks). Memory and time a frame are bounded, however long it runs. The
/// first rectangle of a track tells its outer side: the normal points to the camera.
class RectangleTracker {
 public:
  /// Throws ConfigError.
  explicit RectangleTracker(const TrackingConfig& config);
  ~RectangleTracker();

  /// One frame: rectangles in the fixed frame, seen at `stamp` [s]. Returns the live tracks, ordered by id; the
  /// reference is valid until the next call. A stamp that is not newer than the last frame's is ignored (the tracks are
  /// returned unchanged); a clock that jumped back is the caller's business: see reset(). Rectangles with NaN, without
  /// area or with a pose that is no rotation are ignored.
  const std::vector<Track>& process(double stamp, const std::vector<DetectedRectangle>& rectangles);

  const std::vector<Track>& tracks() const;

  /// Fronts with the size of their track, for the detector's track-guided fit. Only those that were confirmed, are not
  /// lost, and whose size has been observed: a wrong size that is searched for is found again and again.
  ExpectedFronts expected() const;

  /// Fronts of an earlier run, or of another tracker: like those whose tracks ended, they get their ids and histories back
  /// when they return. They count as seen long ago, whatever their stamps say: clocks may be set back. Their stamps stay as
  /// they are until they return; a history that would then not be over yet is put before that (placeBefore). Ids that are
  /// known already, 0 and ids above kLargestId are ignored.
  void remember(std::vector<Track> fronts);

  /// All that remember() of another tracker needs: the live tracks, and those that ended.
  std::vector<Track> knownTracks() const;

  /// Ends one track, live or not, and does not give its id back; all others go on. If it is still in view, it is a new front.
  /// False if there is none with this id.
  bool forget(std::uint32_t id);

  /// New fronts get ids from `id` on, or from where they are anyway.
  void useIdsFrom(std::uint32_t id);
  std::uint32_t nextId() const { return next_id_; }

  /// Forgets all tracks; ids go on counting, so that an id never means two fronts.
  void reset();

 private:
  bool isKnown(std::uint32_t id) const;
  std::uint32_t takeId();
  bool flickers(const TrackMemory& memory) const;
  void endTracks(double stamp);
  bool isSeenAlready(double stamp, const Rectangle& rectangle) const;
  /// Tracks that are not confirmed yet give way to known fronts whose first glimpse was too bad to be recognised. True if
  /// any did; the order of the tracks is lost then.
  bool takeBackYoung(double stamp, const std::vector<DetectedRectangle>& rectangles, const std::vector<int>& track_of);
  void takeBack(double stamp, std::vector<DetectedRectangle>* unclaimed);
  /// Tracks in the place of `rectangle` that are not confirmed, and were missed more often than seen, give way to it.
  void abandonOvertaken(const Rectangle& rectangle);
  void startTracks(double stamp, std::vector<DetectedRectangle> unclaimed);

  TrackingConfig config_;
  std::unique_ptr<RememberedTracks> live_;
  std::unique_ptr<EndedTracks> ended_;
  std::unique_ptr<AbandonedTracks> abandoned_;
  double last_stamp_;
  std::uint32_t next_id_ = 1;  ///< 0 is nobody; after the last one of 32 bits it begins anew with what is free
};

}  // namespace cabinet_articulation::core
