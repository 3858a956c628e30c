// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/articulation/learned_model.h"
#include "cabinet_articulation/kinds/kinds_config.h"
#include "cabinet_articulation/tracking/track.h"
#include "kinds/joint_kind.h"

namespace cabinet_articulation::core {

constexpr double kSureOfType = 0.95;  ///< what is told of a type by less teaches nothing, and begins no motion (ours)

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

  /// Takes a joint's shape in, in place of the one that its front has there. Of more than kMostShapes joints the largest kind
  /// loses its oldest.
  void add(const JointShape& shape);

  /// Whether the joint of this front is there, just like that.
  bool holds(const JointShape& shape) const;

  /// The joint of a front, or nothing.
  std::optional<JointShape> jointOf(std::uint32_t front) const;

  /// Takes out the joint of a front. Kinds that were merged for it stay merged.
  void remove(std::uint32_t front);

  /// Keeps the joint of a front, which is nobody's from now on.
  void disown(std::uint32_t front);

  /// The same without the joint of a front, for that front: what it taught is no news to it.
  JointKinds without(std::uint32_t front) const;

  const std::vector<JointKind>& kinds() const { return kinds_; }

  /// Of all joints.
  std::vector<JointShape> shapes() const;

  /// What is to be expected of a track: `learned` is what its own poses say. It stays as it is where a new kind is more probable
  /// than each known one. Else the answer has the path that is most probable for that kind, and the types' new probabilities;
  /// its covariance and errors are still those of its own poses. A front that may as well rest is taken to move on two
  /// conditions. Its agreement with a kind outweighs `rest_odds`, and leaves no doubt of the type.
  LearnedModel predict(const LearnedModel& learned, const Track& track, const ArticulationConfig& config) const;

  /// What is to be expected of a front that was seen to move, by the joint that its poses tell and its covariance alone
  /// (updatedByKinds()).
  LearnedModel update(const LearnedModel& learned) const;

  /// What is to be expected of a front that was not seen to move, and whose size is known. `at_rest` is the number of fronts of
  /// any size in view that did not move either, with this one; they are as likely things that never move. The answer stays as
  /// `resting` unless one kind is more probable than all else. It then is a joint of that kind that was never observed: the
  /// types' probabilities, axis, covariance, and q from 0 to how far such joints open.
  LearnedModel expect(const LearnedModel& resting, std::size_t at_rest) const;

 private:
  double score(const JointKind& kind) const;
  void settle(std::size_t i);
  void take(std::size_t i, std::vector<JointKind>::iterator kind);

  KindsConfig config_;
  FurniturePrior prior_;
  std::vector<JointKind> kinds_;
};

}  // namespace cabinet_articulation::core
