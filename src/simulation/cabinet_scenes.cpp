// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/cabinet_scenes.h"

#include <cmath>
#include <map>
#include <string>

#include "simulation/scene_factories.h"

namespace cabinet_articulation::core {

Scene makeScene(const SimulationConfig& config) {
  cv::RNG random(static_cast<std::uint64_t>(config.scene_seed) + 1);
  const std::map<std::string, Scene (*)(cv::RNG*)> makers = {
      {"bifold", makeBifold}, {"cupboard", makeCupboard}, {"pedestal", makePedestal}, {"trolley", makeTrolley}};
  const auto maker = makers.find(config.scene);
  Scene scene = maker != makers.end() ? maker->second(&random) : makeKitchen(config.scene, config.hinge == "left", &random);
  scene.name = config.scene;
  return scene;
}

Eigen::Vector3d viewPoint(const Eigen::Vector3d& target, double distance, double azimuth, double elevation) {
  return target + distance * Eigen::Vector3d(std::sin(azimuth) * std::cos(elevation), -std::cos(azimuth) * std::cos(elevation),
                                             std::sin(elevation));
}

}  // namespace cabinet_articulation::core
