// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/articulation/arc_model.h"

namespace cabinet_articulation::core {

/// The front turns about an axis.
class RotationalModel : public ArcModel {
 public:
  explicit RotationalModel(const ArticulationConfig& config) : ArcModel(config, PathShape::kCircle) {}

  JointType type() const override { return JointType::kRotational; }
  int complexity(bool with_orientation) const override { return with_orientation ? 9 : 6; }
  JointGeometry geometry() const override;
  Matrix6d covariance(const PoseTrack& track, const Eigen::Vector3d& p, double correlation) const override;
  std::vector<ModelParam> parameters() const override;
};

}  // namespace cabinet_articulation::core
