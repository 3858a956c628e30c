// SPDX-License-Identifier: BSD-3-Clause
#include "config_catalogue.h"

#include "cabinet_articulation/pipeline/pipeline.h"
#include "cabinet_articulation/simulation/simulated_stereo_camera.h"

namespace cabinet_articulation::core {
namespace {

template <class Config>
ConfigFile entry(const std::string& stage, const std::string& title) {
  const Config defaults;
  return {stage, toYaml(defaults, title), describeConfig(defaults)};
}

}  // namespace

const std::vector<ConfigFile>& configCatalogue() {
  static const std::vector<ConfigFile> catalogue{
      entry<StereoConfig>("stereo", "Block matching: rectified pair to disparity."),
      entry<PlanesConfig>("planes", "Planes, connected regions and their masks."),
      entry<RectanglesConfig>("rectangles", "Rectangular fronts in the plane regions."),
      entry<TrackingConfig>("tracking", "Rectangles over time."),
      entry<ArticulationConfig>("articulation", "How each front moves."),
      entry<SimulationConfig>("simulation", "The simulated active stereo camera."),
  };
  return catalogue;
}

}  // namespace cabinet_articulation::core
