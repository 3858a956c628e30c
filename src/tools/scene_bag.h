// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <set>
#include <string>

#include "cabinet_articulation/simulation/simulation_config.h"

namespace cabinet_articulation {

/// What of a simulated scene goes to a bag.
struct SceneBagConfig {
  core::SimulationConfig simulation;
  int frames = 0;                             ///< 0: one run of the scene's motion; after it nothing moves
  std::set<std::string> inputs = {"stereo"};  ///< of stereo, disparity, depth: the topics that pipeline.launch takes with each
  ros::Time start{1000};                      ///< stamp of the first frame
  std::string camera = "/stereo";             ///< namespace of the topics
  std::string optical_frame = "stereo_left_optical_frame";
  std::string world_frame = "world";  ///< tf says where the optical frame is in it
};

/// Writes the images of all inputs with their CameraInfos, /tf, and <camera>/truth (SceneTruth). Returns the number of frames.
/// Throws std::invalid_argument for an unknown input, core::ConfigError for a setting of the simulation out of range,
/// std::runtime_error in words where the file cannot be written.
int writeSceneBag(const std::string& path, const SceneBagConfig& config);

}  // namespace cabinet_articulation
