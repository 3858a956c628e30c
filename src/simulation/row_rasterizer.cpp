// SPDX-License-Identifier: BSD-3-Clause
#include "row_rasterizer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cabinet_articulation::core {
namespace {

constexpr double kNear = 0.05;  ///< [m] nothing nearer is drawn

std::vector<Eigen::Vector3d> clipNear(const std::array<Eigen::Vector3d, 4>& corners) {
  std::vector<Eigen::Vector3d> kept;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d& p = corners[i];
    const Eigen::Vector3d& next = corners[(i + 1) % corners.size()];
    if (p.z() >= kNear) kept.push_back(p);
    if ((p.z() < kNear) != (next.z() < kNear)) kept.push_back(p + (next - p) * ((kNear - p.z()) / (next.z() - p.z())));
  }
  return kept;
}

__attribute__((target_clones("avx2", "default"))) void fillSpan(float start, float step, int count, int surface,
                                                                float* inverse_depth, int* surfaces) {
  for (int i = 0; i < count; ++i) {
    const float value = start + step * static_cast<float>(i);
    const bool nearer = value > inverse_depth[i];
    inverse_depth[i] = nearer ? value : inverse_depth[i];
    surfaces[i] = nearer ? surface : surfaces[i];
  }
}

}  // namespace

RowRasterizer::RowRasterizer(const PinholeView& view, const std::vector<Surface>& surfaces,
                             const Eigen::Isometry3d& T_view_surfaces)
    : view_(view) {
  for (size_t i = 0; i < surfaces.size(); ++i) {
    Rectangle rectangle = surfaces[i].rectangle;
    rectangle.pose = T_view_surfaces * rectangle.pose;
    const Eigen::Vector3d normal = rectangle.normal();
    const double offset = normal.dot(rectangle.center());
    if (offset >= 0) continue;
    Polygon polygon;
    polygon.surface = static_cast<int>(i);
    polygon.inverse_depth[0] = normal.x() / view.focal / offset;
    polygon.inverse_depth[1] = normal.y() / view.focal / offset;
    polygon.inverse_depth[2] = normal.z() / offset - polygon.inverse_depth[0] * view.cx - polygon.inverse_depth[1] * view.cy;
    const std::vector<Eigen::Vector3d> corners = clipNear(rectangle.corners());
    std::vector<Eigen::Vector2d> pixels;
    for (const Eigen::Vector3d& p : corners)
      pixels.emplace_back(view.focal * p.x() / p.z() + view.cx, view.focal * p.y() / p.z() + view.cy);
    polygon.top = std::numeric_limits<double>::infinity();
    polygon.bottom = -polygon.top;
    double left = polygon.top, right = -polygon.top;
    for (size_t k = 0; k < pixels.size(); ++k) {
      const Eigen::Vector2d& p = pixels[k];
      const Eigen::Vector2d& next = pixels[(k + 1) % pixels.size()];
      if (p.y() != next.y())
        polygon.edges.push_back(
            {p.x(), p.y(), (next.x() - p.x()) / (next.y() - p.y()), std::min(p.y(), next.y()), std::max(p.y(), next.y())});
      polygon.top = std::min(polygon.top, p.y());
      polygon.bottom = std::max(polygon.bottom, p.y());
      left = std::min(left, p.x());
      right = std::max(right, p.x());
    }
    if (polygon.bottom > 0 && polygon.top < view.height && right > 0 && left < view.width) polygons_.push_back(polygon);
  }
}

void RowRasterizer::row(int v, float* inverse_depth, int* surface) const {
  std::fill(inverse_depth, inverse_depth + view_.width, 0.0F);
  std::fill(surface, surface + view_.width, kNoSurface);
  for (const Polygon& polygon : polygons_) {
    if (v < polygon.top || v >= polygon.bottom) continue;
    double left = std::numeric_limits<double>::infinity();
    double right = -left;
    for (const Edge& edge : polygon.edges) {
      if (v < edge.top || v >= edge.bottom) continue;
      const double x = edge.x + (v - edge.y) * edge.slope;
      left = std::min(left, x);
      right = std::max(right, x);
    }
    const int first = static_cast<int>(std::ceil(std::clamp(left, 0.0, double(view_.width))));
    const int end = static_cast<int>(std::ceil(std::clamp(right, 0.0, double(view_.width))));
    const double start = polygon.inverse_depth[0] * first + polygon.inverse_depth[1] * v + polygon.inverse_depth[2];
    if (first < end)
      fillSpan(static_cast<float>(start), static_cast<float>(polygon.inverse_depth[0]), end - first, polygon.surface,
               inverse_depth + first, surface + first);
  }
}

}  // namespace cabinet_articulation::core
