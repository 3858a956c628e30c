// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "cabinet_articulation/joints/joint.h"
#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/// What was learned about a front, and the observations it was learned from.
struct KnownFront {
  LearnedModel model;
  Track track;
};

/// Observations that are kept of a front out of view, or in a file: enough for the fits, which use no more themselves.
constexpr int kKeptObservations = 200;

/// Everything that was learned: the fronts in view, and the joints that are out of view.
///
/// A joint stays known until its own model says that it is given up: a front in view whose model tells less at the moment does
/// not erase it. What is given up stays, with its doubt, but answers no questions any more.
class KnownFronts {
 public:
  /// So many joints are remembered beside those in view; those with the fewest observations go first (some 50 MB, ours).
  static constexpr std::size_t kMostRemembered = 256;

  /// What one frame gave: the live tracks and their models. Joints that are no longer among them are remembered, if they
  /// were seen often enough to be more than an arm that passed.
  void update(std::vector<Track> tracks, const std::vector<LearnedModel>& models);

  /// Throws ModelError for an id nobody knows.
  const LearnedModel& at(std::uint32_t id) const;

  /// All joints worth remembering, in view or not, given up or not, ordered by id.
  std::vector<KnownFront> joints() const;

  /// Their models alone, which is much less to copy.
  std::vector<LearnedModel> jointModels() const;

  /// Forgets everything and remembers these.
  void replace(std::vector<KnownFront> fronts);

  /// Forgets one front and returns what its model was. Throws ModelError for an id nobody knows.
  LearnedModel forget(std::uint32_t id);

 private:
  std::map<std::uint32_t, const KnownFront*> worthKeeping() const;
  void remember(KnownFront front);

  std::map<std::uint32_t, KnownFront> live_, remembered_;  ///< no id is in both with a joint worth keeping
};

}  // namespace cabinet_articulation::core
