// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "cabinet_articulation/articulation/arc_fit.h"
#include "cabinet_articulation/articulation/articulation_model.h"

namespace cabinet_articulation::core {

/// What prismatic and rotational joints share: a path that is a line or a circle.
class ArcModel : public ArticulationModel {
 public:
  ArcModel(const ArticulationConfig& config, PathShape shape) : ArticulationModel(config), shape_(shape) {}

  bool moves() const override { return true; }
  bool fit(const PoseTrack& track) override;
  Eigen::Isometry3d predict(double q) const override { return arc_.pose(first_ + q / unit()); }
  double configuration(const Eigen::Isometry3d& pose) const override;
  double sequenceLogLikelihood(const PoseTrack& track, std::optional<double> rival) override;

 protected:
  /// q per metre of path.
  double unit() const { return shape_ == PathShape::kLine ? 1 : arc_.curvature; }

  /// Covariance of ArcProblem's parameters, for correlated residuals.
  Eigen::MatrixXd parameterCovariance(const PoseTrack& track, double correlation) const;

  Arc arc_;           ///< curvature is not negative
  double first_ = 0;  ///< [m] arc length at q = 0

 private:
  Arc startOf(const PoseSamples& samples) const;
  double arcLength(const Eigen::Isometry3d& pose) const;
  void orient(const PoseSamples& samples);

  PathShape shape_;
  ArcFit fit_;
  std::optional<Arc> sequence_start_;  ///< the last sequence fit's path
  std::size_t searched_at_ = 0;        ///< poses when the sequence fit was started from everywhere last
  std::size_t fitted_to_ = 0;          ///< poses
  bool with_orientation_ = true;
};

}  // namespace cabinet_articulation::core
