// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/learned_model.h"

#include "articulation/models/model_registry.h"

namespace cabinet_articulation::core {

Eigen::Isometry3d LearnedModel::predict(double at) const { return modelEntry(type).predict(*this, at); }

double LearnedModel::configuration(const Eigen::Isometry3d& front) const { return modelEntry(type).configuration(*this, front); }

}  // namespace cabinet_articulation::core
