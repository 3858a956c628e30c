// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "articulation/models/articulation_model.h"

namespace cabinet_articulation::core {

/// The front does not move: one pose, the robust mean of all.
class RigidModel : public ArticulationModel {
 public:
  static constexpr JointTraits kTraits{JointType::kRigid,      "rigid",         ConfigurationUnit::kMetre, /*moves*/ false,
                                       /*is_parametric*/ true, /*turns*/ false, /*is_hinge*/ false,        UrdfJoint::kNone,
                                       palette::kGrey};
  static Eigen::Isometry3d predictLearned(const LearnedModel& model, double q);
  static double configurationOfLearned(const LearnedModel& model, const Eigen::Isometry3d& front);
  static Matrix6d jacobianOfLearned(const LearnedModel& model, double q);
  static LearnedModel example();

  using ArticulationModel::ArticulationModel;

  const JointTraits& traits() const override { return kTraits; }
  int complexity(bool with_orientation) const override { return with_orientation ? 6 : 3; }
  bool fit(const PoseSequence& track, const WorkBudget& budget) override;
  Eigen::Isometry3d predict(double) const override { return pose_; }
  double configuration(const Eigen::Isometry3d&) const override { return 0; }
  JointGeometry geometry() const override { return {}; }
  Matrix6d covariance(const PoseSequence& track, const Eigen::Vector3d& p, double correlation) const override;
  std::vector<ModelParam> parameters() const override;
  /// Not meaningful: slow motion is a sequence like any other, so that a rigid model would explain it.
  SequenceProgress sequenceLogLikelihood(const PoseSequence&, const WorkBudget&, std::optional<double>) override {
    return {-1e300, true};
  }

 private:
  Eigen::Isometry3d pose_ = Eigen::Isometry3d::Identity();
};

}  // namespace cabinet_articulation::core
