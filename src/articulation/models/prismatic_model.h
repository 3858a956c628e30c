// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "articulation/models/arc_model.h"

namespace cabinet_articulation::core {

/// The front slides along a line.
class PrismaticModel : public ArcModel {
 public:
  static constexpr JointTraits kTraits{JointType::kPrismatic,  "prismatic",     ConfigurationUnit::kMetre, /*moves*/ true,
                                       /*is_parametric*/ true, /*turns*/ false, /*is_hinge*/ false,        UrdfJoint::kPrismatic,
                                       palette::kBlue};
  static Eigen::Isometry3d predictLearned(const LearnedModel& model, double q);
  static double configurationOfLearned(const LearnedModel& model, const Eigen::Isometry3d& front);
  static Matrix6d jacobianOfLearned(const LearnedModel& model, double q);
  static LearnedModel example();

  explicit PrismaticModel(const ArticulationConfig& config) : ArcModel(config, PathShape::kLine) {}

  const JointTraits& traits() const override { return kTraits; }
  int complexity(bool with_orientation) const override { return with_orientation ? 7 : 4; }
  JointGeometry geometry() const override;
  Matrix6d covariance(const PoseSequence& track, const Eigen::Vector3d& p, double correlation) const override;
  std::vector<ModelParam> parameters() const override;
};

}  // namespace cabinet_articulation::core
