// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/drawing.h"

#include <algorithm>
#include <cmath>

namespace cabinet_articulation {
namespace {

constexpr int kSides = 16;  ///< of a tube, which then looks round

Eigen::Vector3d onRing(const TubeRing& ring, int side) {
  const double angle = 2 * M_PI * side / kSides;
  return ring.center + std::cos(angle) * ring.half_axis_a + std::sin(angle) * ring.half_axis_b;
}

}  // namespace

void addPath(const std::vector<Eigen::Vector3d>& points, const Paint& paint, Drawing* drawing) {
  for (std::size_t i = 1; i < points.size(); ++i) drawing->lines.push_back({points[i - 1], points[i], paint});
}

void addOutline(const core::Rectangle& rectangle, const Paint& paint, Drawing* drawing) {
  const auto corners = rectangle.corners();
  for (std::size_t i = 0; i < corners.size(); ++i)
    drawing->lines.push_back({corners[i], corners[(i + 1) % corners.size()], paint});
}

void addCross(const core::Rectangle& rectangle, const Paint& paint, Drawing* drawing) {
  const Eigen::Vector3d x = rectangle.width / 2 * rectangle.pose.linear().col(0);
  const Eigen::Vector3d y = rectangle.height / 2 * rectangle.pose.linear().col(1);
  for (const Eigen::Vector3d& half : {x, y})
    drawing->lines.push_back({rectangle.center() - half, rectangle.center() + half, paint});
}

void addFrame(const core::Rectangle& rectangle, float alpha, Drawing* drawing) {
  const double length = std::min(rectangle.width, rectangle.height) / 2;
  for (int k = 0; k < 3; ++k) {
    Color color{};
    color[static_cast<std::size_t>(k)] = 1;
    drawing->lines.push_back({rectangle.center(), rectangle.center() + length * rectangle.pose.linear().col(k), {color, alpha}});
  }
}

void addSurface(const core::Rectangle& rectangle, const Paint& paint, Drawing* drawing) {
  const auto corners = rectangle.corners();
  drawing->triangles.push_back({{corners[0], corners[1], corners[2]}, paint});
  drawing->triangles.push_back({{corners[0], corners[2], corners[3]}, paint});
}

void addTube(const std::vector<TubeRing>& rings, const Paint& paint, Drawing* drawing) {
  for (std::size_t i = 1; i < rings.size(); ++i) {
    for (int side = 0; side < kSides; ++side) {
      const Eigen::Vector3d a = onRing(rings[i - 1], side), b = onRing(rings[i - 1], side + 1);
      const Eigen::Vector3d c = onRing(rings[i], side), d = onRing(rings[i], side + 1);
      drawing->triangles.push_back({{a, b, c}, paint});
      drawing->triangles.push_back({{b, d, c}, paint});
    }
  }
}

}  // namespace cabinet_articulation
