// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "cabinet_articulation/simulation/simulation_config.h"
#include "sources/frame_source.h"

namespace cabinet_articulation::core::evaluation {

/// One run of a scene's motion script, every frame of it.
std::unique_ptr<FrameSource> simulateRun(const SimulationConfig& config);

/// The drawer of the paper's motion-capture experiment (IV-A): unmounted, front 39.5 x 12.5 cm, hung in front of a room. Every
/// frame shows another random pose, 0.6 to 3 m away, tilted by 10 to 50 degrees and rolled by up to 40, with all corners in
/// both images.
std::unique_ptr<FrameSource> simulateHangingDrawer(int poses, int seed);

/// A flat board of 1.6 x 1.2 m that stands across the view, one frame for every distance (paper, Fig. 3).
std::unique_ptr<FrameSource> simulateBoard(const std::string& name, double reflectance, const std::vector<double>& distances);

}  // namespace cabinet_articulation::core::evaluation
