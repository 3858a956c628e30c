// SPDX-License-Identifier: BSD-3-Clause
#include "tools/settings/parameter_tables.h"

#include "cabinet_articulation/pipeline/pipeline.h"
#include "cabinet_articulation/simulation/simulated_stereo_camera.h"
#include "nodelets/running/settings.h"

namespace cabinet_articulation {
namespace {

template <class Config>
void appendRows(std::string* text) {
  for (const core::detail::FieldText& field : core::describeConfig(Config())) {
    const std::string allowed = field.allowed.empty() ? "any text" : field.allowed;
    *text += "| `" + field.key + "` | " + field.unit + " | `" + field.value + "` | " + allowed + " | " + field.meaning + " |\n";
  }
}

/// `Configs` as the nodelet loads them.
template <class... Configs>
ParameterTable table(const std::string& nodelet) {
  std::string text = "| parameter | unit | default | allowed | meaning |\n|---|---|---|---|---|\n";
  (appendRows<Configs>(&text), ...);
  return {nodelet, text};
}

}  // namespace

const std::vector<ParameterTable>& parameterTables() {
  static const std::vector<ParameterTable> tables{
      table<ImageTransportConfig, StageSettings>("rectify"),
      table<core::StereoConfig, SyncConfig, ImageTransportConfig, StageSettings>("stereo"),
      table<core::PlanesConfig, BendFileConfig, FrameInputConfig, SyncConfig, ImageTransportConfig, StageSettings>("planes"),
      table<core::RectanglesConfig, FrameInputConfig, SyncConfig, ImageTransportConfig, StageSettings>("rectangles"),
      table<core::TrackingConfig, FixedFrameConfig, StageSettings>("tracking"),
      table<core::LearningConfig, ModelFileConfig, FrameOutputConfig, StageSettings>("articulation"),
      table<FrameInputConfig, ImageTransportConfig, StageSettings>("overlay"),
      table<core::SimulationConfig, SimulatedCameraSettings>("simulated_stereo_camera"),
  };
  return tables;
}

}  // namespace cabinet_articulation
