// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "articulation/models/articulation_model.h"
#include "cabinet_articulation/articulation/learned_model.h"

namespace cabinet_articulation::core {

/// One kind of joint that can be learned.
struct ModelEntry : JointTraits {
  std::unique_ptr<ArticulationModel> (*create)(const ArticulationConfig& config);
  /// LearnedModel::predict() and configuration().
  Eigen::Isometry3d (*predict)(const LearnedModel& model, double q);
  double (*configuration)(const LearnedModel& model, const Eigen::Isometry3d& front);
  /// How the pose at q changes with the six quantities of LearnedModel::covariance: rows position and rotation vector.
  Matrix6d (*jacobian)(const LearnedModel& model, double q);
  /// A typical joint of this type, closed at q = 0 and open at q_max: the truth for its contract test.
  LearnedModel (*example)();
};

/// All kinds, the simplest first; an entry's index is the value of its type.
const std::vector<ModelEntry>& modelRegistry();

const ModelEntry& modelEntry(JointType type);

/// Those that `config.joint_types` names, the simplest first. Throws ConfigError for a name that none has.
std::vector<const ModelEntry*> chosenModels(const ArticulationConfig& config);

inline const char* modelName(JointType type) { return modelEntry(type).name; }

}  // namespace cabinet_articulation::core
