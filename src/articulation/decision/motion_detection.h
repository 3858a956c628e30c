// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "articulation/models/articulation_model.h"
#include "articulation/observations/pose_sequence.h"
#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/**
 * Whether a front moved (ours). Pieces of furniture that are hardly visible jitter by centimetres and tens of degrees while they
 * stand still. Some point of the front must have come farther than motion_min, and than motion_to_jitter times its jitter from
 * one frame to the next. It must also have come farther than motion_to_noise times its distance from where the model says. It
 * must have been seen in between, and must not go back and forth along the way from one frame to the next. It must do
 * so more clearly where the median observation has less than edge_support_min of its edges on every third of the way. There is
 * no motion in fewer observations than observations_min. Few observations must follow one another at once, and be of nothing
 * small. More are needed of something narrow, as hands and arms are.
 */
class MotionDetector {
 public:
  /// [nats] ln 9: motion that is less probable than 0.9 is not called so yet (ours).
  static constexpr double kLogOdds = 2.2;

  /// Poses (ours): fewer must follow one another at once, and may tell a motion early.
  static constexpr std::size_t kFewPoses = 6;

  /// `poses` are those of `track`'s front, in the order of their stamps.
  MotionDetector(const Track& track, const PoseSequence& poses, const ArticulationConfig& config);

  /// `residuals` are those of `poses`, which may be thinned out.
  bool passes(const ArticulationModel& model, const ModelResiduals& residuals, const PoseSequence& poses) const;

  /// [nats] The odds that a front moved that was seen a few times only, from two on. In place of motion_min counts how far a
  /// point came beside its uncertainty, no faster than hands are; rest_odds are against it. A front that has stood still for
  /// longer is not asked. A plane at rest seems to turn when it takes in a part of something else. Minus infinity: nothing can be
  /// said so early.
  double earlyLogOdds(const ArticulationModel& model, const ModelResiduals& residuals, const PoseSequence& poses) const;

  bool isEvidentEarly(const ArticulationModel& model, const ModelResiduals& residuals, const PoseSequence& poses) const {
    return earlyLogOdds(model, residuals, poses) >= kLogOdds;
  }

  /// [m] Standard deviation of the points of the outline from one frame to the next, in each direction.
  const std::vector<double>& jitter() const { return jitter_; }

 private:
  bool isSteady(const ModelResiduals& residuals, const PoseSequence& poses) const;
  double clarity(double edge_support) const;
  double significance(const Eigen::Vector3d& way, const Eigen::Vector3d& lever) const;
  bool standsOut(double path, std::size_t point, const ModelResiduals& residuals, const PoseSequence& poses) const;

  ArticulationConfig config_;
  bool refused_, few_;
  double one_front_ = 0;  ///< [nats] odds that few observations are of one front
  std::vector<double> jitter_;
  Matrix6d covariance_;  ///< of an observation, in the mean; zero: none was reported
};

}  // namespace cabinet_articulation::core
