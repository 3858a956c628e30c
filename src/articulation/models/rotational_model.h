// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "articulation/models/arc_model.h"

namespace cabinet_articulation::core {

/// The front turns about an axis.
class RotationalModel : public ArcModel {
 public:
  static constexpr JointTraits kTraits{JointType::kRotational, "rotational",   ConfigurationUnit::kRadian, /*moves*/ true,
                                       /*is_parametric*/ true, /*turns*/ true, /*is_hinge*/ true,          UrdfJoint::kRevolute,
                                       palette::kBluishGreen};
  static Eigen::Isometry3d predictLearned(const LearnedModel& model, double q);
  static double configurationOfLearned(const LearnedModel& model, const Eigen::Isometry3d& front);
  static Matrix6d jacobianOfLearned(const LearnedModel& model, double q);
  static LearnedModel example();

  explicit RotationalModel(const ArticulationConfig& config) : ArcModel(config, PathShape::kCircle) {}

  const JointTraits& traits() const override { return kTraits; }
  int complexity(bool with_orientation) const override { return with_orientation ? 9 : 6; }
  double logPrior() const override;
  JointGeometry geometry() const override;
  Matrix6d covariance(const PoseSequence& track, const Eigen::Vector3d& p, double correlation) const override;
  std::vector<ModelParam> parameters() const override;
};

}  // namespace cabinet_articulation::core
