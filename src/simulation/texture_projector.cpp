// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/texture_projector.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "simulation/row_rasterizer.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kTexelsPerCell = 4;
constexpr double kBlack = 0.04;        ///< light that a black square lets through
constexpr double kFieldOfView = 1.2;   ///< the pattern is a little wider than the cameras' view
constexpr double kShadowScale = 0.75;  ///< shadow pixels per pixel of the cameras
// Beside and a little above the left camera; near enough that the pattern looks the same size at any distance (III-A).
const Eigen::Vector3d kPosition(0.05, -0.035, 0.0);  // [m]

/// A random grid, every square kTexelsPerCell texels wide.
cv::Mat1f makePattern(const SimulationConfig& config, const cv::Size& cells) {
  cv::Mat1f squares(cells);
  cv::RNG random(static_cast<std::uint64_t>(config.pattern_seed) + 1);
  random.fill(squares, cv::RNG::UNIFORM, 0.0, 1.0);
  cv::Mat1f pattern;
  for (float& square : squares) square = square < 0.5F ? static_cast<float>(kBlack) : 1.0F;
  cv::resize(squares, pattern, {}, kTexelsPerCell, kTexelsPerCell, cv::INTER_NEAREST);
  // Bilinear look-up alone would leave steps; half a texel of blur hides them.
  const double sigma = kTexelsPerCell * std::hypot(config.pattern_blur, 0.5 / kTexelsPerCell);
  cv::GaussianBlur(pattern, pattern, {}, sigma);
  return pattern;
}

}  // namespace

PinholeView PinholeView::scaled(double factor) const {
  const double shift = (factor - 1) / 2;
  return {focal * factor, cx * factor + shift, cy * factor + shift, static_cast<int>(std::ceil(width * factor)),
          static_cast<int>(std::ceil(height * factor))};
}

TextureProjector::TextureProjector(const SimulationConfig& config)
    : T_projector_left_(Eigen::Translation3d(-kPosition)), shadows_(config.shadows) {
  const cv::Size cells(static_cast<int>(kFieldOfView * config.width / config.pattern_cell),
                       static_cast<int>(kFieldOfView * config.height / config.pattern_cell));
  pattern_ = makePattern(config, cells);
  pattern_view_ = {config.focal_length / config.pattern_cell * kTexelsPerCell, (pattern_.cols - 1) / 2.0,
                   (pattern_.rows - 1) / 2.0, pattern_.cols, pattern_.rows};
  shadow_view_ = pattern_view_.scaled(kShadowScale * config.pattern_cell / kTexelsPerCell);
  shadow_inverse_depth_ = cv::Mat1f::zeros(shadow_view_.height, shadow_view_.width);
  shadow_surface_ = cv::Mat1i(shadow_inverse_depth_.size(), kNoSurface);
}

void TextureProjector::castShadows(const std::vector<Surface>& surfaces_left) {
  if (!shadows_) return;
  const RowRasterizer rasterizer(shadow_view_, surfaces_left, T_projector_left_);
  for (int v = 0; v < shadow_view_.height; ++v) rasterizer.row(v, shadow_inverse_depth_[v], shadow_surface_[v]);
}

}  // namespace cabinet_articulation::core
