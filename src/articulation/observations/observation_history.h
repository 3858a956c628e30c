// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "articulation/observations/ambiguous_turns.h"
#include "articulation/observations/pose_jitter.h"
#include "articulation/observations/pose_sequence.h"
#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/// A point of a front's rectangle: x, y in half widths and heights from the centre.
struct ReferencePoint {
  int x = 0;
  int y = 0;

  /// Its place in the front's own frame.
  Eigen::Vector3d offset(double width, double height) const { return {x * width / 2, y * height / 2, 0}; }
};

/// The usable observations of a track, ready for fits and in the order of their stamps. An update costs as much as what
/// is new.
class ObservationHistory {
 public:
  explicit ObservationHistory(const ArticulationConfig& config)
      : config_(config), turns_(config.sigma_position, config.sigma_orientation) {}

  /// Takes over what the track has now. False, and nothing changes, if it has no usable observation.
  bool update(const Track& track);

  /// Whether the track is the one of the last update, with new observations after those, of which some may be left out.
  bool isContinuedBy(const Track& track) const { return firstNew(track).has_value(); }

  /// From now on observations before `stamp` are left out, also of a history that is placed anew.
  void leaveOutBefore(double stamp);
  bool leavesOut() const { return first_ > 0; }

  /// Those that are not left out.
  std::size_t size() const { return entries_.size() - first_; }

  /// [m] Mean deviation of the measured width or height, whichever varies more.
  double sizeDeviation() const;

  /// The track of a reference point: at most `count` poses, evenly spaced, the first and the last among them. Of long rests there
  /// are fewer. With another pose they stay the same but for the last, until their spacing doubles. Sizes are those measured with
  /// each pose (ours: the mean size is worse where it is the far edge that is seen well).
  PoseSequence evenlySpaced(ReferencePoint point, std::size_t count) const;

  /// The same in runs of poses that follow one another at once. Runs are spread evenly over the time and the front's way; the
  /// newest pose is among them.
  PoseSequence runs(ReferencePoint point, std::size_t count) const;

  /// As evenlySpaced(), those that are left out among them.
  PoseSequence withLeftOut(ReferencePoint point, std::size_t count) const;

  /// The same, evenly spaced along the centre's way: rest has no say, however long, nor has the frame rate.
  PoseSequence alongWholeWay(ReferencePoint point, std::size_t count) const;

  /// The poses after `stamp`.
  PoseSequence since(ReferencePoint point, double stamp) const;

  /// The point itself and, where there are orientations, the front's corners as seen from it. They are those of a rectangle of
  /// this size, or of a marker whose turns count as much as a sigma of its place.
  std::vector<Eigen::Vector3d> outline(ReferencePoint point, double width, double height) const;

 private:
  struct Entry {
    double stamp = 0;
    Eigen::Isometry3d center = Eigen::Isometry3d::Identity();
    double width = 0, height = 0;
    float edge_support = 0;
    bool weighted = false;
    Eigen::Matrix3d position_weight, orientation_weight;
    double rested = 0;  ///< poses since the centre went on by 3 sigma_position
    double place = 0;   ///< by which poses are evenly spaced: their number, where long rests count less
    double way = 0;     ///< [m] that the centre went from the first pose to here, in steps of sigma_position or more
  };

  std::optional<std::size_t> firstNew(const Track& track) const;
  void removeWhatIsNotIn(const Track& track);
  void findFirst();
  void measureWay(std::size_t from);
  void measureJitter(bool continues);
  std::vector<std::size_t> runStarts(std::size_t runs, std::size_t length) const;
  std::vector<std::size_t> indicesAtPlaces(std::size_t first, std::size_t count) const;
  std::vector<std::size_t> indicesAtSteps(double Entry::*measure, double step, std::size_t first, std::size_t count) const;
  PoseSequence picked(ReferencePoint point, const std::vector<std::size_t>& indices) const;
  void append(const TrackedObservation& observation, std::vector<Entry>* entries);
  void redescribe(const AmbiguousTurns::Description& description, std::vector<Entry>* entries);

  ArticulationConfig config_;
  std::vector<Entry> entries_;
  std::size_t first_ = 0;  ///< index of the first entry that is not left out
  Eigen::Vector3d way_anchor_ = Eigen::Vector3d::Zero(), rest_anchor_ = way_anchor_;
  AmbiguousTurns turns_;
  bool weighted_ = false;
  PoseJitter jitter_;
  std::size_t jitter_measured_at_ = 0;              ///< poses
  Eigen::Vector2d size_ = Eigen::Vector2d::Zero();  ///< [m] width and height, estimated over the track
  // What of the track was taken over.
  std::uint32_t revision_ = 0;
  std::size_t observations_ = 0;
  double first_stamp_ = 0, last_stamp_ = 0;
  double not_before_ = -std::numeric_limits<double>::infinity();  ///< [s]
};

}  // namespace cabinet_articulation::core
