// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "articulation/fitting/arc_fit.h"
#include "articulation/models/articulation_model.h"

namespace cabinet_articulation::core {

/// What prismatic and rotational joints share: a path that is a line or a circle.
class ArcModel : public ArticulationModel {
 public:
  ArcModel(const ArticulationConfig& config, PathShape shape) : ArticulationModel(config), shape_(shape) {}

  bool fit(const PoseSequence& track, const WorkBudget& budget) override;
  void moveReference(const Eigen::Vector3d& offset) override;
  Eigen::Isometry3d predict(double q) const override { return arc_.pose(first_ + q / unit()); }
  double configuration(const Eigen::Isometry3d& pose) const override;
  /// [m] Robust standard deviation of the positions about the path.
  double positionNoise() const { return fit_.position_scale; }

  SequenceProgress sequenceLogLikelihood(const PoseSequence& track, const WorkBudget& budget,
                                         std::optional<double> rival) override;

 protected:
  /// q per metre of path.
  double unit() const { return shape_ == PathShape::kLine ? 1 : arc_.curvature; }

  /// Covariance of ArcProblem's parameters, for correlated residuals.
  Eigen::MatrixXd parameterCovariance(const PoseSequence& track, double correlation) const;

  Arc arc_;           ///< curvature is not negative
  double first_ = 0;  ///< [m] arc length at q = 0

 private:
  bool isEnough(const PoseSequence& track) const;
  Arc startOf(const PoseSamples& samples) const;
  void take(const PoseSamples& samples, const ArcFit& fit);
  void fitAnew(const PoseSamples& samples);
  void continueFit(const PoseSequence& track, const PoseSamples& samples, int steps);
  void continueBesidesFresh(const PoseSamples& samples, int steps, int all);
  SequenceFit sequenceFit(const PoseSamples& samples, const SequenceFit& start, const FitEffort& effort) const;
  SequenceProgress compareAnew(const PoseSamples& samples, std::optional<double> rival);
  SequenceProgress continueComparison(const PoseSamples& samples, int steps, std::optional<double> rival);
  void startFromFitIfBetter(const PoseSamples& samples);
  void tryOtherStart(const PoseSamples& samples, int steps);
  double arcLength(const Eigen::Isometry3d& pose) const;
  void orient(const PoseSamples& samples);

  PathShape shape_;
  ArcFit fit_;
  std::optional<ArcFit> fresh_;  ///< from where the poses say, which may become better
  int fresh_steps_ = 0;
  std::optional<SequenceFit> sequence_;  ///< the best so far
  std::vector<SequenceFit> others_;      ///< from other starts, which may become better
  std::size_t searched_at_ = 0;          ///< poses when the sequence fit was started from everywhere last
  int updates_ = 0;                      ///< since the fit was last started from the poses
  bool fitted_ = false;
  bool with_orientation_ = true;
};

}  // namespace cabinet_articulation::core
