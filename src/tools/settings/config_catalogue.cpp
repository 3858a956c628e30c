// SPDX-License-Identifier: BSD-3-Clause
#include "tools/settings/config_catalogue.h"

#include "cabinet_articulation/pipeline/pipeline.h"
#include "cabinet_articulation/simulation/simulated_stereo_camera.h"

namespace cabinet_articulation::core {
namespace {

/// The files of one folder below config/.
void add(const std::string& folder, const PipelineConfig& pipeline, const std::string& values, std::vector<ConfigFile>* files) {
  const auto file = [&](const std::string& stage, const auto& config, const std::string& title, const std::string& origin) {
    files->push_back({folder + stage, toYaml(config, title, origin), describeConfig(config)});
  };
  file("stereo", pipeline.stereo, "Block matching: rectified pair to disparity.", values);
  file("planes", pipeline.planes, "Planes, connected regions and their masks.", values);
  file("rectangles", pipeline.rectangles, "Rectangular fronts in the plane regions.", values);
  file("tracking", pipeline.tracking, "Rectangles over time.", values);
  file("articulation", LearningConfig{pipeline.articulation, pipeline.kinds, pipeline.structure}, "How each front moves.",
       values);
  file("simulation", SimulationConfig(), "The simulated active stereo camera.", "its default");
}

std::vector<ConfigFile> allFiles() {
  std::vector<ConfigFile> files;
  add("", {}, "its default", &files);
  add("paper/", PipelineConfig::paper(), "its value in the paper's recipe, see PipelineConfig::paper()", &files);
  return files;
}

}  // namespace

const std::vector<ConfigFile>& configCatalogue() {
  static const std::vector<ConfigFile> catalogue = allFiles();
  return catalogue;
}

}  // namespace cabinet_articulation::core
