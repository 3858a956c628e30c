// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/simulation/scene.h"
#include "simulation/texture_projector.h"

namespace cabinet_articulation::core {

constexpr int kNoSurface = -1;

/// Finds the nearest surface for every pixel of one image row at a time, so that the z-buffer stays in the cache.
class RowRasterizer {
 public:
  /// `T_view_surfaces` takes the surfaces into the view's optical frame. What faces away or lies outside is dropped.
  RowRasterizer(const PinholeView& view, const std::vector<Surface>& surfaces, const Eigen::Isometry3d& T_view_surfaces);

  /// Inverse depth [1/m] and the index of the surface, or 0 and kNoSurface, for `view.width` pixels of row `v`.
  void row(int v, float* inverse_depth, int* surface) const;

 private:
  void add(const Rectangle& rectangle, int surface);

  struct Edge {
    double x, y, slope, top, bottom;
  };
  struct Polygon {
    int surface;
    double top, bottom;
    double inverse_depth[3];  ///< 1/z = [0] u + [1] v + [2]
    std::vector<Edge> edges;
  };
  PinholeView view_;
  std::vector<Polygon> polygons_;
};

}  // namespace cabinet_articulation::core
