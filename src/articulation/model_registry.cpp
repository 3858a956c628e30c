// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/model_registry.h"

#include "cabinet_articulation/articulation/prismatic_model.h"
#include "cabinet_articulation/articulation/rigid_model.h"
#include "cabinet_articulation/articulation/rotational_model.h"

namespace cabinet_articulation::core {
namespace {

template <class Model>
std::unique_ptr<ArticulationModel> create(const ArticulationConfig& config) {
  return std::make_unique<Model>(config);
}

}  // namespace

const std::vector<ModelEntry>& modelRegistry() {
  static const std::vector<ModelEntry> registry{
      {JointType::kRigid, "rigid", &ArticulationConfig::rigid, create<RigidModel>},
      {JointType::kPrismatic, "prismatic", &ArticulationConfig::prismatic, create<PrismaticModel>},
      {JointType::kRotational, "rotational", &ArticulationConfig::rotational, create<RotationalModel>},
  };
  return registry;
}

const char* modelName(JointType type) { return modelRegistry().at(static_cast<std::size_t>(type)).name; }

}  // namespace cabinet_articulation::core
