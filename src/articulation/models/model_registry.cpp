// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/models/model_registry.h"

#include "articulation/models/nonparametric_model.h"
#include "articulation/models/prismatic_model.h"
#include "articulation/models/rigid_model.h"
#include "articulation/models/rotational_model.h"

namespace cabinet_articulation::core {
namespace {

template <class Model>
ModelEntry entry(bool ArticulationConfig::*enabled) {
  const auto create = [](const ArticulationConfig& config) -> std::unique_ptr<ArticulationModel> {
    return std::make_unique<Model>(config);
  };
  return {{Model::kTraits},         enabled,       create, Model::predictLearned, Model::configurationOfLearned,
          Model::jacobianOfLearned, Model::example};
}

}  // namespace

const std::vector<ModelEntry>& modelRegistry() {
  static const std::vector<ModelEntry> registry{
      entry<RigidModel>(&ArticulationConfig::rigid),
      entry<PrismaticModel>(&ArticulationConfig::prismatic),
      entry<RotationalModel>(&ArticulationConfig::rotational),
      entry<NonparametricModel>(&ArticulationConfig::nonparametric),
  };
  return registry;
}

const ModelEntry& modelEntry(JointType type) { return modelRegistry().at(static_cast<std::size_t>(type)); }

}  // namespace cabinet_articulation::core
