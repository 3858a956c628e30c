// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/row_rasterizer.h"

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
    if (rectangle.normal().dot(rectangle.center()) < 0) add(rectangle, static_cast<int>(i));
  }
}

void RowRasterizer::add(const Rectangle& rectangle, int surface) {
  Polygon polygon;
  polygon.surface = surface;
  // The plane n.p = h gives 1/z = n.r / h for the ray r with z = 1.
  const Eigen::Vector3d scaled_normal = rectangle.normal() / rectangle.normal().dot(rectangle.center());
  polygon.inverse_depth[0] = scaled_normal.x() / view_.focal;
  polygon.inverse_depth[1] = scaled_normal.y() / view_.focal;
  polygon.inverse_depth[2] = scaled_normal.z() - polygon.inverse_depth[0] * view_.cx - polygon.inverse_depth[1] * view_.cy;
  Eigen::AlignedBox2d bounds;
  std::vector<Eigen::Vector2d> pixels;
  for (const Eigen::Vector3d& p : clipNear(rectangle.corners())) {
    pixels.emplace_back(view_.focal * p.x() / p.z() + view_.cx, view_.focal * p.y() / p.z() + view_.cy);
    bounds.extend(pixels.back());
  }
  if (pixels.empty() ||
      !bounds.intersects(Eigen::AlignedBox2d(Eigen::Vector2d(0, 0), Eigen::Vector2d(view_.width, view_.height))))
    return;
  polygon.top = bounds.min().y();
  polygon.bottom = bounds.max().y();
  for (size_t k = 0; k < pixels.size(); ++k) {
    const Eigen::Vector2d& p = pixels[k];
    const Eigen::Vector2d& next = pixels[(k + 1) % pixels.size()];
    if (p.y() == next.y()) continue;
    const double slope = (next.x() - p.x()) / (next.y() - p.y());
    polygon.edges.push_back({p.x(), p.y(), slope, std::min(p.y(), next.y()), std::max(p.y(), next.y())});
  }
  polygons_.push_back(polygon);
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
