// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/articulation/learned_model.h"
#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/// Paper III-D: candidate models for every track, the best one selected (Eq. 11).
class ArticulationLearner {
 public:
  explicit ArticulationLearner(const ArticulationConfig& config);
  ~ArticulationLearner();

  /// The models of all tracks given, ordered by id. Of tracks that are no longer given, only joints stay known, for when their
  /// id returns. A track without any usable observation has no model; observations that are not finite are ignored.
  std::vector<LearnedModel> process(const std::vector<Track>& tracks);

  /// Joints of an earlier run. A track with the id of one of them is taken for it until observations contradict.
  void remember(const std::vector<LearnedModel>& joints);

  void forget(std::uint32_t id);
  void reset();

 private:
  struct State;
  ArticulationConfig config_;
  std::unique_ptr<State> state_;
};

/// All candidate models of one track, the best first; empty if no observation is usable. Special cases that a simpler joint makes
/// improbable are left out, as a screw without a pitch.
std::vector<LearnedModel> fitAllModels(const Track& track, const ArticulationConfig& config);

}  // namespace cabinet_articulation::core
