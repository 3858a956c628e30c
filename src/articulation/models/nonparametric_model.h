// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "articulation/fitting/curve_fit.h"
#include "articulation/models/articulation_model.h"
#include "articulation/paths/pose_curve.h"

namespace cabinet_articulation::core {

/// The front follows some smooth curve of poses, as one that slides and turns does. The configuration q is the length of the way
/// [m] of the observed point.
class NonparametricModel : public ArticulationModel {
 public:
  static constexpr JointTraits kTraits{JointType::kNonparametric, "nonparametric", ConfigurationUnit::kMetre, /*moves*/ true,
                                       /*is_parametric*/ false,   /*turns*/ false, /*is_hinge*/ false,        UrdfJoint::kNone,
                                       palette::kReddishPurple};
  static constexpr std::size_t kLeastPoses = 8;  ///< fewer are not fitted
  static Eigen::Isometry3d predictLearned(const LearnedModel& model, double q);
  static double configurationOfLearned(const LearnedModel& model, const Eigen::Isometry3d& front);
  static Matrix6d jacobianOfLearned(const LearnedModel& model, double q);
  static LearnedModel example();
  /// False for models of other programs that name no way, or one too short to divide by.
  static bool hasWay(const LearnedModel& model);

  using ArticulationModel::ArticulationModel;

  const JointTraits& traits() const override { return kTraits; }
  int complexity(bool with_orientation) const override;
  bool fit(const PoseSequence& track, const WorkBudget& budget) override;
  Eigen::Isometry3d predict(double q) const override { return curve_.pose(q); }
  double configuration(const Eigen::Isometry3d& pose) const override { return curve_.nearest(pose, metres_per_radian_); }
  /// The axis is the direction from one end of what was seen to the other.
  JointGeometry geometry() const override;
  std::vector<Eigen::Isometry3d> curve(double q_min, double q_max) const override;
  Matrix6d covariance(const PoseSequence& track, const Eigen::Vector3d& p, double correlation) const override;
  std::vector<ModelParam> parameters() const override;
  /// Not meaningful: a free curve follows any slow sequence.
  SequenceProgress sequenceLogLikelihood(const PoseSequence&, const WorkBudget&, std::optional<double>) override {
    return {-1e300, true};
  }

 private:
  void fitAll(const PoseSamples& samples);
  void fitOne(const PoseSamples& samples);
  void take(const CurveFit& fit, const PoseSequence& track);

  std::vector<CurveFit> fits_;  ///< that started along a line and along a circle
  int refits_ = 0;
  PoseCurve curve_;  ///< of the better one
  double metres_per_radian_ = 0;
  double position_scale_ = 0, orientation_scale_ = 0;
  double freedom_ = 0;
  double variance_ = 0;  ///< of a coordinate at q = 0, in units of its squared scale
  std::size_t samples_ = 0;
};

}  // namespace cabinet_articulation::core
