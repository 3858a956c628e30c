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
  int first_frame = 0;                        ///< where in the scene's motion the bag begins
  int frames = 0;                             ///< 0: to the end of the scene's motion; after it nothing moves
  int rounds = 1;                             ///< the same frames so often, each time with the same stamps (a bag in a loop)
  std::set<std::string> inputs = {"stereo"};  ///< of stereo, disparity, depth: the topics that pipeline.launch takes with each
  ros::Time start{1000};                      ///< stamp of the first frame
  std::string camera = "/stereo";             ///< namespace of the topics
  std::string optical_frame = "stereo_left_optical_frame";
  std::string world_frame = "world";  ///< tf says where the optical frame is in it
};

/// Writes the images of all inputs with their CameraInfos, /tf, and <camera>/truth (SceneTruth). Returns the number of frames.
/// Record times grow throughout, stamps begin anew with each round. Throws std::invalid_argument for an unknown input or a
/// first frame after the end of the motion. A setting of the simulation out of range is a core::ConfigError, and a file that
/// cannot be written a std::runtime_error in words.
int writeSceneBag(const std::string& path, const SceneBagConfig& config);

}  // namespace cabinet_articulation
