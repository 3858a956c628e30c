// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "articulation/fitting/pitch_fit.h"
#include "articulation/models/rotational_model.h"

namespace cabinet_articulation::core {

/// The front turns about an axis and advances along it, as a lid on its thread or the seat of a stool does (ours). Without the
/// advance, its poses are those of a rotational joint. It may turn more than once.
class ScrewModel : public ArticulationModel {
 public:
  // URDF knows no such joint.
  static constexpr JointTraits kTraits{JointType{4},           "screw",          ConfigurationUnit::kRadian,
                                       /*moves*/ true,
                                       /*is_parametric*/ true,
                                       /*turns*/ true,
                                       /*is_hinge*/ false,     UrdfJoint::kNone, palette::kSkyBlue};
  static Eigen::Isometry3d predictLearned(const LearnedModel& model, double q);
  static double configurationOfLearned(const LearnedModel& model, const Eigen::Isometry3d& front);
  static Matrix6d jacobianOfLearned(const LearnedModel& model, double q);
  static LearnedModel example();

  explicit ScrewModel(const ArticulationConfig& config) : ArticulationModel(config), turning_(config) {}

  const JointTraits& traits() const override { return kTraits; }
  int complexity(bool with_orientation) const override { return turning_.complexity(with_orientation) + 1; }
  double logPrior() const override;
  double largestAdvantage() const override;
  bool fit(const PoseSequence& track, const WorkBudget& budget) override;
  void startFrom(const ArticulationModel& fitted) override;
  void moveReference(const Eigen::Vector3d& offset) override { turning_.moveReference(offset); }
  Eigen::Isometry3d predict(double q) const override;
  double configuration(const Eigen::Isometry3d& pose) const override;
  std::vector<double> configurations(const PoseSequence& track) const override;
  JointGeometry geometry() const override;
  Matrix6d covariance(const PoseSequence& track, const Eigen::Vector3d& p, double correlation) const override;
  std::vector<ModelParam> parameters() const override;
  SequenceProgress sequenceLogLikelihood(const PoseSequence& track, const WorkBudget& budget,
                                         std::optional<double> rival) override;

 private:
  bool fitAnew(const PoseSequence& track);
  void fitTurn(const PoseSequence& track, const WorkBudget& budget, std::vector<double>* turns);
  void fitPitch(const PoseSequence& track, const std::vector<double>& turns);
  double advance(double turn) const { return pitch_.value * turn + shift_; }
  double turnOf(const Eigen::Isometry3d& pose, double least, double most) const;
  double offAlongAxis(const Eigen::Isometry3d& pose, double turn) const;
  std::vector<double> unwrappedTurns(const PoseSequence& track) const;
  std::vector<double> turnsOf(const PoseSequence& track) const;
  PoseSequence withoutAdvance(const PoseSequence& track, const std::vector<double>& turns) const;
  PitchEstimate bestPitch(const PoseSequence& track, const std::vector<double>& turns) const;
  void findShift(const PoseSequence& track, const std::vector<double>& turns);
  void orient(const PoseSequence& track, const std::vector<double>& turns);

  RotationalModel turning_;  ///< of the poses without the advance; its q is the turn
  PitchEstimate pitch_;
  double shift_ = 0;             ///< [m] advance at turn 0
  double first_ = 0;             ///< [rad] turn at q = 0
  double direction_ = 1;         ///< of q against that of the turn
  double least_ = 0, most_ = 0;  ///< [rad] turns that were seen
  bool fitted_ = false, with_orientation_ = true;
  bool has_start_ = false;   ///< the turn was fitted by another joint
  bool turns_next_ = false;  ///< the next continued fit is to the turn, not to the pitch
};

}  // namespace cabinet_articulation::core
