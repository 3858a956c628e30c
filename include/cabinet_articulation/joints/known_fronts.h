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

/// Everything that was learned: the fronts in view, and the joints that are out of view.
class KnownFronts {
 public:
  /// What one frame gave: the live tracks and their models. Joints that are no longer among them are remembered, if they
  /// were seen often enough to be more than an arm that passed.
  void update(std::vector<Track> tracks, const std::vector<LearnedModel>& models);

  /// Throws ModelError for an id nobody knows.
  const LearnedModel& at(std::uint32_t id) const;

  /// All joints worth remembering, in view or not, ordered by id.
  std::vector<KnownFront> joints() const;

  /// Forgets everything and remembers these.
  void replace(std::vector<KnownFront> fronts);

 private:
  std::map<std::uint32_t, KnownFront> live_, remembered_;
};

}  // namespace cabinet_articulation::core
