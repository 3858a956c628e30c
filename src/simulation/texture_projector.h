// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <vector>

#include "cabinet_articulation/simulation/scene.h"
#include "cabinet_articulation/simulation/simulation_config.h"

namespace cabinet_articulation::core {

/// A pinhole camera or projector as the rasterizer sees it; pixel centres at whole coordinates.
struct PinholeView {
  double focal = 0;  ///< [px]
  double cx = 0;     ///< [px]
  double cy = 0;     ///< [px]
  int width = 0;
  int height = 0;

  /// The same view with `factor` times as many pixels in each direction, the last ones perhaps beyond the view.
  PinholeView scaled(double factor) const;
};

/// Projects a fixed random grid of black and white squares (paper, III-A) from a point beside the left camera.
class TextureProjector {
 public:
  explicit TextureProjector(const SimulationConfig& config);

  /// Brightness of the pattern, 0..1, blurred by the projector's defocus.
  const cv::Mat1f& pattern() const { return pattern_; }
  const PinholeView& patternView() const { return pattern_view_; }
  const Eigen::Isometry3d& T_projector_left() const { return T_projector_left_; }

  /// What the projector's light reaches first: inverse depth [1/m] and index of the surface for every pixel of
  /// `shadowView()`. Surfaces in the left optical frame.
  void castShadows(const std::vector<Surface>& surfaces_left);
  const PinholeView& shadowView() const { return shadow_view_; }
  const cv::Mat1f& shadowInverseDepth() const { return shadow_inverse_depth_; }
  const cv::Mat1i& shadowSurface() const { return shadow_surface_; }

 private:
  cv::Mat1f pattern_;
  PinholeView pattern_view_, shadow_view_;
  Eigen::Isometry3d T_projector_left_;
  bool shadows_;
  cv::Mat1f shadow_inverse_depth_;
  cv::Mat1i shadow_surface_;
};

}  // namespace cabinet_articulation::core
