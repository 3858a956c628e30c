// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/models/model_registry.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>
#include <string>

#include "articulation/models/nonparametric_model.h"
#include "articulation/models/prismatic_model.h"
#include "articulation/models/rigid_model.h"
#include "articulation/models/rotational_model.h"
#include "articulation/models/screw_model.h"

namespace cabinet_articulation::core {
namespace {

template <class Model>
ModelEntry entry() {
  const auto create = [](const ArticulationConfig& config) -> std::unique_ptr<ArticulationModel> {
    return std::make_unique<Model>(config);
  };
  return {{Model::kTraits},         create,        Model::predictLearned, Model::configurationOfLearned,
          Model::jacobianOfLearned, Model::example};
}

}  // namespace

const std::vector<ModelEntry>& modelRegistry() {
  static const std::vector<ModelEntry> registry{
      entry<RigidModel>(), entry<PrismaticModel>(), entry<RotationalModel>(), entry<NonparametricModel>(), entry<ScrewModel>(),
  };
  return registry;
}

std::vector<const ModelEntry*> chosenModels(const ArticulationConfig& config) {
  std::istringstream text(config.joint_types);
  std::set<std::string> names{std::istream_iterator<std::string>(text), {}};
  const bool all = names.erase("all") > 0;
  std::vector<const ModelEntry*> chosen;
  std::string known;
  for (const ModelEntry& entry : modelRegistry()) {
    if (names.erase(entry.name) > 0 || all) chosen.push_back(&entry);
    known += std::string(" ") + entry.name;
  }
  const auto is_parametric = [](const ModelEntry* entry) { return entry->is_parametric; };
  if (!names.empty() || std::none_of(chosen.begin(), chosen.end(), is_parametric))
    throw ConfigError("setting 'joint_types' is '" + config.joint_types + "', expected all or some of" + known +
                      ", not a free curve alone");
  return chosen;
}

const ModelEntry& modelEntry(JointType type) { return modelRegistry().at(static_cast<std::size_t>(type)); }

}  // namespace cabinet_articulation::core
