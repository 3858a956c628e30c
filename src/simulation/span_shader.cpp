// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/span_shader.h"

#include <algorithm>
#include <cmath>

namespace cabinet_articulation::core {
namespace {

/// Nearer by more than this share means that something else is lit first; smaller differences are rounding.
constexpr float kShadowBias = 0.004F;

/// Ambient light comes mostly from above.
double ambientShare(const Eigen::Vector3d& normal) { return 0.75 - 0.25 * normal.y(); }

LinearInImage inPixels(const Eigen::Vector3d& of_ray, const PinholeView& view) {
  const double a = of_ray.x() / view.focal;
  const double b = of_ray.y() / view.focal;
  return {static_cast<float>(a), static_cast<float>(b), static_cast<float>(of_ray.z() - a * view.cx - b * view.cy)};
}

struct Span {
  float x, dx, y, dy, z, dz, slant, dslant;
  float lit, unlit;
  float focal, cx, cy;
  int index, count;
};

struct Maps {
  const float* pattern;
  int stride;
  float max_x, max_y;
  const float* shadow_depth;
  const int* shadow_surface;
  int shadow_stride;
  float shadow_scale, shadow_shift;
};

__attribute__((target_clones("avx2", "default"))) void shadeSpan(const Span& s, const Maps& maps, float* radiance) {
  const Span span = s;
  const Maps m = maps;
  for (int i = 0; i < span.count; ++i) {
    const float k = static_cast<float>(i);
    const float x = span.x + span.dx * k;
    const float y = span.y + span.dy * k;
    const float z = span.z + span.dz * k;
    const float slant = span.slant + span.dslant * k;
    const float inverse_z = 1.0F / z;
    const float texel_x = span.focal * x * inverse_z + span.cx;
    const float texel_y = span.focal * y * inverse_z + span.cy;
    const float inside_x = std::min(std::max(texel_x, 0.0F), m.max_x);
    const float inside_y = std::min(std::max(texel_y, 0.0F), m.max_y);
    const bool inside = (inside_x == texel_x) & (inside_y == texel_y) & (z > 0);

    const int column = static_cast<int>(inside_x);
    const int row = static_cast<int>(inside_y);
    const float fx = inside_x - static_cast<float>(column);
    const float fy = inside_y - static_cast<float>(row);
    const float* texel = m.pattern;
    const int at = row * m.stride + column;
    const float top = texel[at] + fx * (texel[at + 1] - texel[at]);
    const float bottom = texel[at + m.stride] + fx * (texel[at + m.stride + 1] - texel[at + m.stride]);
    const float light = top + fy * (bottom - top);

    const int shadow = static_cast<int>(inside_y * m.shadow_scale + m.shadow_shift) * m.shadow_stride +
                       static_cast<int>(inside_x * m.shadow_scale + m.shadow_shift);
    const float inverse_depth = slant * inverse_z;
    const bool reached = (m.shadow_surface[shadow] == span.index) | (inverse_depth >= m.shadow_depth[shadow] * (1 - kShadowBias));

    // Inverse square and cosine: h / r^3 with r = |(x, y, z)| / slant.
    const float inverse_r = slant / std::sqrt(x * x + y * y + z * z);
    const float irradiance = span.lit * inverse_r * inverse_r * inverse_r * light;
    radiance[i] = span.unlit + ((inside & reached) ? irradiance : 0.0F);
  }
}

}  // namespace

SpanShader::SpanShader(const Surface& surface, int index, const PinholeView& camera, const Eigen::Isometry3d& T_projector_camera,
                       double ambient, const TextureProjector& projector)
    : index_(index), projector_(&projector) {
  // Away from the camera, so that the distance and the slant of everything visible are positive.
  const Eigen::Vector3d normal = -surface.rectangle.normal();
  const double distance = normal.dot(surface.rectangle.center());
  const Eigen::Vector3d projector_in_camera = T_projector_camera.inverse().translation();
  const Eigen::Matrix3d to_projector =
      T_projector_camera.linear() * (distance * Eigen::Matrix3d::Identity() - projector_in_camera * normal.transpose());
  x_ = inPixels(to_projector.row(0), camera);
  y_ = inPixels(to_projector.row(1), camera);
  z_ = inPixels(to_projector.row(2), camera);
  slant_ = inPixels(normal, camera);
  lit_ = static_cast<float>(surface.reflectance * std::max(0.0, distance - normal.dot(projector_in_camera)));
  unlit_ = static_cast<float>(surface.reflectance * ambient * ambientShare(-normal));
  const PinholeView& pattern = projector.patternView();
  focal_ = static_cast<float>(pattern.focal);
  cx_ = static_cast<float>(pattern.cx);
  cy_ = static_cast<float>(pattern.cy);
}

void SpanShader::shade(float u, float v, int count, float* radiance) const {
  const auto at = [u, v](const LinearInImage& f) { return f.a * u + f.b * v + f.c; };
  const Span span{at(x_), x_.a, at(y_), y_.a, at(z_), z_.a, at(slant_), slant_.a, lit_, unlit_, focal_, cx_, cy_, index_, count};
  const cv::Mat1f& pattern = projector_->pattern();
  const PinholeView& shadow = projector_->shadowView();
  const float scale = static_cast<float>(shadow.focal / projector_->patternView().focal);
  // + 0.5 rounds to the nearest shadow pixel; half a pixel less at the rim keeps the look-up inside.
  const Maps maps{pattern[0],
                  pattern.cols,
                  static_cast<float>(pattern.cols) - 1.01F,
                  static_cast<float>(pattern.rows) - 1.01F,
                  projector_->shadowInverseDepth()[0],
                  projector_->shadowSurface()[0],
                  shadow.width,
                  scale,
                  (scale - 1) / 2 + 0.5F};
  shadeSpan(span, maps, radiance);
}

}  // namespace cabinet_articulation::core
