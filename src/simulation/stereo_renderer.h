// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "cabinet_articulation/geometry/stereo_camera.h"
#include "cabinet_articulation/simulation/scene.h"
#include "simulation/texture_projector.h"

namespace cabinet_articulation::core {

/// Light that reaches the two sensors, before blur and noise. A white square at 1 m on white paper gives 1.
struct RenderedPair {
  cv::Mat1f left, right;  ///< radiance
  cv::Mat1f depth;        ///< [m] along the left optical axis at the pixel's centre, 0 = nothing
};

/// Draws matt planar surfaces that the projector and the room light. Perspective is exact: 1/z of a plane is linear in the
/// image, and its pattern is a homography (ours: what makes a pair cost milliseconds on one core).
class StereoRenderer {
 public:
  StereoRenderer(const SimulationConfig& config, const StereoCamera& camera);

  /// Surfaces in the left optical frame. The result's memory is reused by the next call.
  const RenderedPair& render(const std::vector<Surface>& surfaces_left);

 private:
  void renderView(const std::vector<Surface>& surfaces_left, double offset_x, cv::Mat1f* radiance, cv::Mat1f* depth);

  StereoCamera camera_;
  double ambient_;
  TextureProjector projector_;
  RenderedPair result_;
};

}  // namespace cabinet_articulation::core
