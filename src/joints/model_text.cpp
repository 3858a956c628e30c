// SPDX-License-Identifier: BSD-3-Clause
#include "joints/model_text.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "cabinet_articulation/joints/hanging.h"
#include "joints/front_merge.h"
#include "joints/kind_fields.h"
#include "joints/model_file_fields.h"
#include "tracking/motion/history.h"

namespace cabinet_articulation::core {
namespace {

constexpr char kTitle[] = "# Doors and drawers that were learned.";
constexpr char kFormat[] = "cabinet_articulation models";
constexpr char kEnd[] = "complete";  ///< the last key, so that a file that was cut off is noticed
constexpr int kVersion = 1;
constexpr int kVersionWithParents = 2;  ///< programs that know no parents must not place what hangs on one

void checkHead(const YAML::Node& root) {
  if (!root.IsMap() || !root["format"] || !root["format"].IsScalar() || root["format"].Scalar() != kFormat)
    throw std::runtime_error("holds no models of this program");
  const std::string version = root["version"] && root["version"].IsScalar() ? root["version"].Scalar() : "missing";
  if (version != std::to_string(kVersion) && version != std::to_string(kVersionWithParents))
    throw std::runtime_error("its version is " + version + ", this program reads the versions " + std::to_string(kVersion) +
                             " and " + std::to_string(kVersionWithParents));
  if (!root[kEnd]) throw std::runtime_error("is cut off: its last line is missing");
  if (!root["frame"] || !root["frame"].IsScalar() || !root["fronts"] || !root["fronts"].IsSequence())
    throw std::runtime_error("'frame' or 'fronts' is missing");
}

}  // namespace

std::string toText(const ModelFile& models) {
  YAML::Node root;
  root["format"] = kFormat;
  const bool has_parents =
      std::any_of(models.fronts.begin(), models.fronts.end(), [](const KnownFront& front) { return front.model.parent != 0; });
  root["version"] = has_parents ? kVersionWithParents : kVersion;
  root["frame"] = models.frame;
  root["fronts"] = YAML::Node(YAML::NodeType::Sequence);
  for (KnownFront front : models.fronts) {
    while (thinOut(front.track.observations, kKeptObservations)) continue;
    root["fronts"].push_back(toYaml(front));
  }
  for (const JointShape& shape : models.kinds) root["kinds"].push_back(toYaml(shape));
  root[kEnd] = true;
  YAML::Emitter emitter;
  emitter << root;
  return std::string(kTitle) + " Metres and radians; poses are x y z qx qy qz qw.\n" + emitter.c_str() + "\n";
}

ModelFile modelsFromText(const std::string& text) {
  const YAML::Node root = YAML::Load(text);
  checkHead(root);
  ModelFile models;
  models.frame = root["frame"].Scalar();
  std::set<std::uint32_t> ids;
  std::set<std::string> names;
  for (std::size_t i = 0; i < root["fronts"].size(); ++i) {
    try {
      models.fronts.push_back(frontFromYaml(root["fronts"][i]));
      const LearnedModel& model = models.fronts.back().model;
      if (!ids.insert(model.id).second) throw std::runtime_error("its id is there twice");
      if (!model.name.empty() && !names.insert(model.name).second) throw std::runtime_error("its name is there twice");
    } catch (const std::exception& error) {
      throw std::runtime_error("front " + std::to_string(i + 1) + ": " + error.what());
    }
  }
  requireNoCycle(modelsOf(models.fronts));
  models.kinds = shapesFromYaml(root["kinds"]);
  std::vector<std::uint32_t> taken;
  models.changes = giveFreeIds(&models.fronts, &taken);
  return models;
}

bool wasModelFile(const std::string& text) {
  return text.rfind(kTitle, 0) == 0 || text.find("format: " + std::string(kFormat) + "\n") != std::string::npos;
}

}  // namespace cabinet_articulation::core
