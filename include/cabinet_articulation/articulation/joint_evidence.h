// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "cabinet_articulation/articulation/articulation_model.h"
#include "cabinet_articulation/articulation/learned_model.h"

namespace cabinet_articulation::core {

/**
 * Evidence for and against a joint (ours). What a front did once it did: rest, thinned histories and hidden edges say nothing
 * against that, only poses off the joint's path do.
 *
 * A joint is established when the likelihood that its front moved outweighs the prior of a rectangle that does. Observations
 * on its path support it, each at least sigma_position from the last one that did, so that neither rest nor the frame rate
 * counts. Observations off the path contradict it, and each one on the path takes one of those back. The joint is given up
 * when as many contradict as support it.
 */
class JointEvidence {
 public:
  explicit JointEvidence(const ArticulationConfig& config) : config_(config) {}

  bool isEstablished() const { return support_ > 0; }

  /// LearnedModel::support and LearnedModel::doubt.
  double support() const { return support_; }
  double doubt() const { return given_up_ ? 1 : isEstablished() ? contrary_ / support_ : 0; }

  /// [s] The first of the observations that led to giving the joint up.
  double contradictedSince() const { return contradicted_since_; }

  /// [s] The newest observation that was weighed.
  double weighedUntil() const { return weighed_until_; }

  /// What was known of a joint in an earlier run.
  void remember(const LearnedModel& joint);

  /// Establishes a joint that was found just now in `poses`, if these `log_odds` [nats] that the front moved are enough, or if
  /// another joint of the same front is established already.
  void consider(const ArticulationModel& joint, const PoseTrack& poses, double log_odds);

  /// New poses, which are on the path if the joint as it was known or, unless null, as it was refined says so. False if the
  /// joint is given up.
  bool weigh(const ArticulationModel& known, const ArticulationModel* refined, const PoseTrack& poses);

  /// Whether at least half of the poses are on the joint's path.
  static bool isOnPath(const ArticulationModel& joint, const PoseTrack& poses);

 private:
  void count(const Eigen::Isometry3d& place, const PoseTrack& poses);

  ArticulationConfig config_;
  double support_ = 0, contrary_ = 0;  ///< observations
  bool given_up_ = false;
  double contradicted_since_ = 0, weighed_until_ = 0;
  std::optional<Eigen::Isometry3d> counted_;  ///< the last place that supported the joint
};

}  // namespace cabinet_articulation::core
