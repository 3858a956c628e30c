// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "cabinet_articulation/articulation/learned_model.h"
#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/// A front that hangs on another one: its track as seen from there, and the joint that was learned from it.
class HangingFront {
 public:
  HangingFront(std::uint32_t parent, double probability, double pause)
      : parent_(parent), probability_(probability), pause_(pause) {}

  std::uint32_t parent() const { return parent_; }
  double probability() const { return probability_; }

  /// Whether the parent is known to be a joint. While it is none, nobody can tell where its frame is.
  bool isPlaceable() const { return is_placeable_; }
  void setPlaceable(bool is_placeable) { is_placeable_ = is_placeable; }

  void setProbability(double probability) { probability_ = probability; }

  /// Both tracks as they are now. `carrier_joint` is how the parent moves in the world. A parent that is known better by now
  /// places all observations anew (Track::revision).
  void follow(const Track& track, const Track& carrier, const LearnedModel& carrier_joint);

  /// The track in the parent's frame.
  const Track& seen() const { return seen_; }

  void learn(const LearnedModel& joint) { joint_ = joint; }

  /// As it was learned last.
  const LearnedModel& joint() const { return joint_; }

  /// As others are told of it. `ratio`: see ratioOfCoupled().
  LearnedModel describe(std::optional<double> ratio) const;

 private:
  std::uint32_t parent_;
  double probability_, pause_;
  bool is_placeable_ = true;
  std::optional<LearnedModel> carrier_joint_;  ///< that `seen_` was placed by
  Track seen_;
  std::uint32_t revisions_ = 0;  ///< of the carrier's joint
  LearnedModel joint_;
};

}  // namespace cabinet_articulation::core
