// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/stereo_renderer.h"

#include <algorithm>
#include <array>

#include "simulation/row_rasterizer.h"
#include "simulation/span_shader.h"

namespace cabinet_articulation::core {
namespace {

/// Samples per pixel and direction that decide which surfaces a pixel sees. Odd: the middle one is the pixel's centre.
constexpr int kSamples = 3;
constexpr int kCentre = kSamples / 2;

/// The visible surfaces of one image row.
struct SampledRow {
  explicit SampledRow(int width) {
    for (auto& row : surface) row.resize(static_cast<size_t>(width) * kSamples);
    for (auto& row : inverse_depth) row.resize(static_cast<size_t>(width) * kSamples);
  }

  void fill(const RowRasterizer& rasterizer, int v) {
    for (int k = 0; k < kSamples; ++k) rasterizer.row(v * kSamples + k, inverse_depth[k].data(), surface[k].data());
  }

  /// The only surface the pixel sees.
  bool isUniform(int u) const {
    const int first = surface[0][u * kSamples];
    bool uniform = true;
    for (int k = 0; k < kSamples; ++k)
      for (int j = 0; j < kSamples; ++j) uniform = uniform && surface[k][u * kSamples + j] == first;
    return uniform;
  }

  int centreSurface(int u) const { return surface[kCentre][u * kSamples + kCentre]; }
  float centreInverseDepth(int u) const { return inverse_depth[kCentre][u * kSamples + kCentre]; }

  std::array<std::vector<int>, kSamples> surface;
  std::array<std::vector<float>, kSamples> inverse_depth;
};

/// A pixel at an edge: every surface in it is shaded once, at the mean of its samples.
float shadeMixed(const SampledRow& row, const std::vector<SpanShader>& shaders, int u, int v) {
  float radiance = 0;
  std::array<int, kSamples * kSamples> ids;
  for (int i = 0; i < kSamples * kSamples; ++i) ids[i] = row.surface[i / kSamples][u * kSamples + i % kSamples];
  for (int i = 0; i < kSamples * kSamples; ++i) {
    const int id = ids[i];
    if (id == kNoSurface || std::find(ids.begin(), ids.begin() + i, id) != ids.begin() + i) continue;
    int count = 0, sum_u = 0, sum_v = 0;
    for (int k = i; k < kSamples * kSamples; ++k) {
      if (ids[k] != id) continue;
      ++count;
      sum_u += k % kSamples - kCentre;
      sum_v += k / kSamples - kCentre;
    }
    const float share = 1.0F / static_cast<float>(count * kSamples);
    float one = 0;
    shaders[id].shade(static_cast<float>(u) + share * static_cast<float>(sum_u),
                      static_cast<float>(v) + share * static_cast<float>(sum_v), 1, &one);
    radiance += one * static_cast<float>(count) / (kSamples * kSamples);
  }
  return radiance;
}

void shadeRow(const SampledRow& row, const std::vector<SpanShader>& shaders, int v, int width, float* radiance) {
  for (int u = 0; u < width;) {
    const int id = row.centreSurface(u);
    int end = u;
    while (end < width && row.centreSurface(end) == id && row.isUniform(end)) ++end;
    if (end == u) {
      radiance[u] = shadeMixed(row, shaders, u, v);
      ++u;
      continue;
    }
    if (id == kNoSurface)
      std::fill(radiance + u, radiance + end, 0.0F);
    else
      shaders[id].shade(static_cast<float>(u), static_cast<float>(v), end - u, radiance + u);
    u = end;
  }
}

}  // namespace

StereoRenderer::StereoRenderer(const SimulationConfig& config, const StereoCamera& camera)
    : camera_(camera), ambient_(config.ambient), projector_(config) {}

const RenderedPair& StereoRenderer::render(const std::vector<Surface>& surfaces_left) {
  projector_.castShadows(surfaces_left);
  renderView(surfaces_left, 0, &result_.left, &result_.depth);
  renderView(surfaces_left, camera_.baseline, &result_.right, nullptr);
  return result_;
}

void StereoRenderer::renderView(const std::vector<Surface>& surfaces_left, double offset_x, cv::Mat1f* radiance,
                                cv::Mat1f* depth) {
  const PinholeView view{camera_.fx, camera_.cx, camera_.cy, camera_.width, camera_.height};
  const Eigen::Isometry3d T_left_view(Eigen::Translation3d(offset_x, 0, 0));
  const Eigen::Isometry3d T_projector_view = projector_.T_projector_left() * T_left_view;
  const Eigen::Isometry3d T_view_left = T_left_view.inverse();
  std::vector<SpanShader> shaders;
  for (size_t i = 0; i < surfaces_left.size(); ++i) {
    Surface surface = surfaces_left[i];
    surface.rectangle.pose = T_view_left * surface.rectangle.pose;
    shaders.emplace_back(surface, static_cast<int>(i), view, T_projector_view, ambient_, projector_);
  }
  const RowRasterizer rasterizer(view.scaled(kSamples), surfaces_left, T_view_left);
  SampledRow row(view.width);
  radiance->create(view.height, view.width);
  if (depth) depth->create(view.height, view.width);
  for (int v = 0; v < view.height; ++v) {
    row.fill(rasterizer, v);
    shadeRow(row, shaders, v, view.width, (*radiance)[v]);
    for (int u = 0; depth && u < view.width; ++u) {
      const float inverse_depth = row.centreInverseDepth(u);
      (*depth)(v, u) = inverse_depth > 0 ? 1.0F / inverse_depth : 0.0F;
    }
  }
}

}  // namespace cabinet_articulation::core
