// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "articulation/models/articulation_model.h"
#include "articulation/models/model_registry.h"

namespace cabinet_articulation::core {

/// A joint as it was learned before, for residuals of new poses. It is never fitted.
class KnownJoint : public ArticulationModel {
 public:
  /// `reference`: the observed point, in the front's frame as seen from its centre.
  KnownJoint(const LearnedModel& joint, const Eigen::Vector3d& reference, const ArticulationConfig& config)
      : ArticulationModel(config), joint_(joint), reference_(reference) {}

  const JointTraits& traits() const override { return modelEntry(joint_.type); }
  int complexity(bool) const override { return 0; }
  bool fit(const PoseSequence&, const WorkBudget&) override { return false; }
  Eigen::Isometry3d predict(double q) const override { return joint_.predict(q) * Eigen::Translation3d(reference_); }
  double configuration(const Eigen::Isometry3d& pose) const override {
    return joint_.configuration(pose * Eigen::Translation3d(-reference_));
  }
  JointGeometry geometry() const override { return {joint_.axis, joint_.axis_point, joint_.radius, joint_.pitch}; }
  Matrix6d covariance(const PoseSequence&, const Eigen::Vector3d&, double) const override { return joint_.covariance; }
  std::vector<ModelParam> parameters() const override { return {}; }
  SequenceProgress sequenceLogLikelihood(const PoseSequence&, const WorkBudget&, std::optional<double>) override { return {}; }

 private:
  const LearnedModel& joint_;
  const Eigen::Vector3d reference_;
};

}  // namespace cabinet_articulation::core
