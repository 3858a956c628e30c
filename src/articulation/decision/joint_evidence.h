// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "articulation/models/articulation_model.h"
#include "cabinet_articulation/articulation/learned_model.h"

namespace cabinet_articulation::core {

/**
 * Evidence for and against a joint (ours). What a front did once it did: rest, thinned histories and hidden edges say nothing
 * against that, only poses off the joint's path do.
 *
 * A joint is established when the likelihood that its front moved outweighs the prior of a rectangle that does. Observations on
 * its path support it, those off the path contradict it. On either side only those count that are at least sigma_position from
 * all that did before. So neither rest, nor the frame rate, nor repeated use counts. Each observation on the path takes back one
 * that contradicts. The joint is given up when half as many contradict as support it, but no fewer than five.
 */
class JointEvidence {
 public:
  explicit JointEvidence(const ArticulationConfig& config) : config_(config) {}

  bool isEstablished() const { return support_ > 0; }

  /// LearnedModel::support and LearnedModel::doubt.
  double support() const { return support_; }
  double doubt() const;

  /// [s] The first of the observations that led to giving the joint up; -infinity before there is one.
  double contradictedSince() const { return contradicted_since_; }

  /// [s] The newest observation that was weighed.
  double weighedUntil() const { return weighed_until_; }

  /// What was known of a joint in an earlier run.
  void remember(const LearnedModel& joint);

  /// A joint that was found just now in `poses`. It is established if the `log_odds` [nats] that the front moved are enough, or
  /// if it replaces one that is.
  void consider(const ArticulationModel& joint, const PoseSequence& poses, double log_odds);

  /// New poses, which are on the path if the joint as it was known or, unless null, as it was refined says so. False if the
  /// joint is given up.
  bool weigh(const ArticulationModel& known, const ArticulationModel* refined, const PoseSequence& poses);

  /// Whether at least half of the poses are on the joint's path.
  static bool isOnPath(const ArticulationModel& joint, const PoseSequence& poses);

  /// Whether the path of `refined` leads where the joint was seen from q_min to q_max.
  bool isRefinement(const ArticulationModel& known, double q_min, double q_max, const ArticulationModel& refined) const;

 private:
  using Place = std::vector<Eigen::Vector3d>;  ///< where the front's corners are

  bool isNew(const Place& place, const std::vector<Place>& places) const;
  void support(const Place& place);
  double enough() const;

  static constexpr double kNever = -std::numeric_limits<double>::infinity();

  ArticulationConfig config_;
  double support_ = 0, contrary_ = 0;  ///< observations
  bool given_up_ = false;
  double contradicted_since_ = kNever, weighed_until_ = kNever;
  std::vector<Place> supporting_, contradicting_;  ///< that counted, of the joint and of a row that contradicts
};

}  // namespace cabinet_articulation::core
