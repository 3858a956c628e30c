// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/joints/prediction.h"
#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/// Poses in the curve of a model from outside: those that are learned have 33, and each projection looks at all (ours).
constexpr std::size_t kMostCurvePoses = 100;

/// Throws ModelError, with the reason in words, unless a model from outside says where its front is: an axis of unit length, or a
/// curve with a range.
void requireShape(const LearnedModel& model);

/// A model from outside as a joint that answers questions, whatever it says of its own observations. Throws ModelError as
/// requireShape(), and for a rigid one, which has no openings.
LearnedModel takenAsJoint(LearnedModel model);

/// How well a model explains a track. Lists have one entry for each observation.
struct TrackEvaluation {
  std::vector<NearestConfiguration> nearest;  ///< of the observed centre; q is 0 of what is rigid
  std::vector<Eigen::Isometry3d> projected;   ///< the model's pose at that q
  double position_error = 0;                  ///< [m] mean residual
  double orientation_error = 0;               ///< [rad]
  double outlier_ratio = 0;                   ///< share of poses more than 3 standard deviations off
  /// [nats] Eqs. (6) to (10) for the poses of the front's centre, as the learner counts it: with what each observation says of
  /// its own noise, and a limit to what a false detection costs. Differences between models of one track mean something.
  double log_likelihood = 0;
  /// [nats] Of it, what the model pays for q: Eq. (6), of models that move. It grows with the path, so that likelihoods of tracks
  /// of different length compare without it.
  double cost_of_freedom = 0;
};

/// Nothing is learned. Throws ModelError as requireShape(), and for a track without any usable observation.
TrackEvaluation evaluateOnTrack(const LearnedModel& model, const Track& track, const ArticulationConfig& config);

}  // namespace cabinet_articulation::core
