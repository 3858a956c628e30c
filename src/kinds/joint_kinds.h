// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/articulation/learned_model.h"
#include "cabinet_articulation/tracking/track.h"
#include "kinds/joint_kind.h"
#include "kinds/kinds_config.h"

namespace cabinet_articulation::core {

/**
 * Kinds of joints, learned from joints, as a prior for the next one (ours).
 *
 * A kind is what joints have in common as their fronts see them where they were first seen, wherever they are. Joints are grouped
 * by the evidence of each kind and a Chinese restaurant process over groupings, so that there is always room for a new kind. The
 * original release merges by BIC instead, which has no scale for how much joints of a kind differ.
 */
class JointKinds {
 public:
  JointKinds(const KindsConfig& config, const FurniturePrior& prior);

  /// Takes a learned joint in. `track`: what it was learned from; its poses without orientations have those of the frame. False,
  /// and nothing changes, of a joint that is neither prismatic nor rotational, was not seen to move, or is not explained.
  bool add(const LearnedModel& joint, const Track& track, const ArticulationConfig& config);

  const std::vector<JointKind>& kinds() const { return kinds_; }

  /// What is to be expected of a track: `learned` is what its own poses say. It stays as it is where a new kind is more probable
  /// than each known one. Else the answer has the path that is most probable for that kind, and the types' new probabilities;
  /// its covariance and errors are still those of its own poses. A front that may as well rest is taken to move on two
  /// conditions. Its agreement with a kind outweighs `rest_odds`, and leaves no doubt of the type.
  LearnedModel predict(const LearnedModel& learned, const Track& track, const ArticulationConfig& config) const;

 private:
  double score(const JointKind& kind) const;
  void merge();

  KindsConfig config_;
  FurniturePrior prior_;
  std::vector<JointKind> kinds_;
};

}  // namespace cabinet_articulation::core
