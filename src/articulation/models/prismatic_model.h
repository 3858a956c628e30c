// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "articulation/models/arc_model.h"

namespace cabinet_articulation::core {

/// The front slides along a line.
class PrismaticModel : public ArcModel {
 public:
  static constexpr JointType kType = JointType::kPrismatic;
  static constexpr ConfigurationUnit kUnit = ConfigurationUnit::kMetre;
  static Eigen::Isometry3d predictLearned(const LearnedModel& model, double q);
  static double configurationOfLearned(const LearnedModel& model, const Eigen::Isometry3d& front);

  explicit PrismaticModel(const ArticulationConfig& config) : ArcModel(config, PathShape::kLine) {}

  JointType type() const override { return kType; }
  int complexity(bool with_orientation) const override { return with_orientation ? 7 : 4; }
  JointGeometry geometry() const override;
  Matrix6d covariance(const PoseSequence& track, const Eigen::Vector3d& p, double correlation) const override;
  std::vector<ModelParam> parameters() const override;
};

}  // namespace cabinet_articulation::core
