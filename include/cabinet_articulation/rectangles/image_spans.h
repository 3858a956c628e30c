// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "cabinet_articulation/rectangles/plane_chart.h"

namespace cabinet_articulation::core {

/// Area of a quadrilateral [px^2], also of the part outside the image.
inline double area(const ImageQuad& quad) {
  const Eigen::Vector2d a = quad[2] - quad[0];
  const Eigen::Vector2d b = quad[3] - quad[1];
  return std::abs(a.x() * b.y() - a.y() * b.x()) / 2;
}

/// Calls use(v, u_begin, u_end) for each image row with the pixels [u_begin, u_end) whose centres lie in a convex
/// quadrilateral, clipped to the image; a centre exactly on an edge may go either way. No allocation; some 3 ns a row.
template <class Use>
void forEachSpan(const ImageQuad& quad, int width, int height, Use&& use) {
  int top = 0;
  for (int i = 1; i < 4; ++i)
    if (quad[i].y() < quad[top].y()) top = i;
  // Two chains of edges lead down from the topmost corner; each knows its u at the current row and the step to the next.
  struct Chain {
    int corner, direction;
    double u = 0, step = 0, bottom = -std::numeric_limits<double>::infinity();
  };
  Chain chains[2] = {{top, 1}, {top, 3}};
  const int v_begin = static_cast<int>(std::ceil(std::max(quad[top].y(), 0.0)));
  double lowest = quad[0].y();
  for (int i = 1; i < 4; ++i) lowest = std::max(lowest, quad[i].y());
  const int v_end = static_cast<int>(std::floor(std::min(lowest, height - 1.0))) + 1;
  for (int v = v_begin; v < v_end; ++v) {
    for (Chain& chain : chains) {
      chain.u += chain.step;
      while (chain.bottom < v) {
        const Eigen::Vector2d& from = quad[chain.corner];
        chain.corner = (chain.corner + chain.direction) % 4;
        const Eigen::Vector2d& to = quad[chain.corner];
        if (to.y() < v) continue;
        chain.step = to.y() > from.y() ? (to.x() - from.x()) / (to.y() - from.y()) : 0;
        chain.u = from.x() + chain.step * (v - from.y());
        chain.bottom = to.y();
      }
    }
    const double left = std::max(std::min(chains[0].u, chains[1].u), 0.0);
    const double right = std::min(std::max(chains[0].u, chains[1].u), width - 1.0);
    const int u_begin = static_cast<int>(std::ceil(left));
    const int u_end = static_cast<int>(std::floor(right)) + 1;
    if (u_begin < u_end) use(v, u_begin, u_end);
  }
}

}  // namespace cabinet_articulation::core
