// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "rectangles/chart/plane_chart.h"

namespace cabinet_articulation::core {

/// Area of a quadrilateral [px^2], also of the part outside the image.
inline double area(const ImageQuad& quad) {
  const Eigen::Vector2d a = quad[2] - quad[0];
  const Eigen::Vector2d b = quad[3] - quad[1];
  return std::abs(a.x() * b.y() - a.y() * b.x()) / 2;
}

namespace detail {

/// One of the two chains of edges that lead down from a quadrilateral's topmost corner.
struct EdgeChain {
  int corner;
  int direction;  ///< to the next corner, modulo 4
  double u = 0, step = 0, bottom = -std::numeric_limits<double>::infinity();

  /// Moves on to the edge that crosses row v.
  void seek(const ImageQuad& quad, int v) {
    while (bottom < v) {
      const Eigen::Vector2d& from = quad[corner];
      corner = (corner + direction) % 4;
      const Eigen::Vector2d& to = quad[corner];
      if (to.y() < v) continue;
      step = to.y() > from.y() ? (to.x() - from.x()) / (to.y() - from.y()) : 0;
      u = from.x() + step * (v - from.y());
      bottom = to.y();
    }
  }
};

}  // namespace detail

/// Calls use(v, u_begin, u_end) for each image row with the pixels [u_begin, u_end) whose centres lie in a convex
/// quadrilateral, clipped to the image; a centre exactly on an edge may go either way. With a `row_step` above 1, only rows
/// that are its multiples. No allocation; some 3 ns a row. Corners may be anywhere: spans are cut to the image before they become
/// integers.
template <class Use>
void forEachSpan(const ImageQuad& quad, int width, int height, int row_step, Use&& use) {
  const auto lower = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.y() < b.y(); };
  const auto [top, lowest] = std::minmax_element(quad.begin(), quad.end(), lower);
  const int first = static_cast<int>(top - quad.begin());
  detail::EdgeChain a{first, 1}, b{first, 3};
  // In this order std::min and std::max never give what is not a number.
  const double right_limit = width - 1.0, bottom_limit = height - 1.0;
  int v = static_cast<int>(std::ceil(std::min(bottom_limit + 1, std::max(0.0, top->y())) / row_step)) * row_step;
  const int v_end = static_cast<int>(std::floor(std::min(bottom_limit, std::max(-1.0, lowest->y())))) + 1;
  while (v < v_end) {
    a.seek(quad, v);
    b.seek(quad, v);
    const int v_stop = std::min(v_end, static_cast<int>(std::min({static_cast<double>(v_end), a.bottom, b.bottom})) + 1);
    for (; v < v_stop; v += row_step, a.u += row_step * a.step, b.u += row_step * b.step) {
      const double left = std::min(right_limit + 1, std::max(0.0, std::min(a.u, b.u)));
      const double right = std::max(-1.0, std::min(right_limit, std::max(a.u, b.u)));
      // Truncation rounds down, for nothing is negative here except an empty span.
      const int truncated = static_cast<int>(left);
      const int u_begin = truncated + (truncated < left ? 1 : 0);
      const int u_end = static_cast<int>(right + 1);
      if (u_begin < u_end) use(v, u_begin, u_end);
    }
  }
}

}  // namespace cabinet_articulation::core
