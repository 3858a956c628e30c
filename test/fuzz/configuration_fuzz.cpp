// SPDX-License-Identifier: BSD-3-Clause
#include <dynamic_reconfigure/Config.h>

#include "cabinet_articulation/pipeline/pipeline.h"
#include "cabinet_articulation/simulation/simulation_config.h"
#include "fuzz_target.h"
#include "nodelets/running/settings.h"
#include "ros/settings/live_settings.h"
#include "scratch_file.h"
#include "tools/settings/config_catalogue.h"

using namespace cabinet_articulation;

fuzz::Seeds fuzz::seeds() {
  std::vector<std::string> texts;
  for (const core::ConfigFile& file : core::configCatalogue()) texts.push_back(file.yaml);
  return {texts};
}

/// A file of settings, taken for that of each stage in turn, as process_bag and detect_image load it. The settings of the
/// nodelets come by the same lists.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::ScratchFile file("settings.yaml");
  file.write(data, size);
  return fuzz::examine<core::ConfigError>([] {
    const core::ConfigValues values = core::readYamlFile(file.path());
    bool known = false;
    core::ConfigError refusal("");
    const auto load = [&](auto config) {
      try {
        core::applyConfig(values, config);
        toTuning(config);
        known = true;
      } catch (const core::ConfigError& error) {
        refusal = error;
      }
      return config;
    };
    const core::PipelineConfig config{load(core::StereoConfig()),       load(core::PlanesConfig()),
                                      load(core::RectanglesConfig()),   load(core::TrackingConfig()),
                                      load(core::ArticulationConfig()), load(core::KindsConfig()),
                                      load(core::StructureConfig())};
    load(StageSettings());
    load(FixedFrameConfig());
    load(ModelFileConfig());
    load(core::SimulationConfig());
    if (!known) throw refusal;
    core::Pipeline pipeline(config);
  });
}
