// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "cabinet_articulation/articulation/articulation_model.h"

namespace cabinet_articulation::core {

/// One kind of joint that can be learned.
struct ModelEntry {
  JointType type;
  const char* name;                   ///< as in the original release
  bool ArticulationConfig::*enabled;  ///< the setting that makes it a candidate
  std::unique_ptr<ArticulationModel> (*create)(const ArticulationConfig& config);
};

/// All kinds, the simplest first; an entry's index is the value of its type.
const std::vector<ModelEntry>& modelRegistry();

const char* modelName(JointType type);

}  // namespace cabinet_articulation::core
