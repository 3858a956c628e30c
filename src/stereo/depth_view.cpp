// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/stereo/depth_view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cabinet_articulation/geometry/limits.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kMostCells = 80;  ///< along the longer side (ours: 19 kB a view, and 40 cells on a small drawer's front at 1.5 m)

/// Of the nine pixels around u, v; 0 unless most of them were measured.
float medianDisparity(const cv::Mat1f& disparity, int u, int v) {
  std::array<float, 9> values;
  std::size_t count = 0;
  for (int y = std::max(v - 1, 0); y <= std::min(v + 1, disparity.rows - 1); ++y)
    for (int x = std::max(u - 1, 0); x <= std::min(u + 1, disparity.cols - 1); ++x)
      if (isValidDisparity(disparity(y, x))) values[count++] = disparity(y, x);
  if (2 * count <= values.size()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

/// The mean over a cell of what belongs to the surface in its middle. Steps and noise of the depth are larger than what is to be
/// told from it. 0 unless that surface was measured.
float surfaceDisparity(const cv::Mat1f& disparity, const cv::Rect& cell) {
  constexpr float kSurface = 0.015F;  // share of the disparity: 4 sigma of a Kinect's noise at 2 m
  const float middle = medianDisparity(disparity, cell.x + cell.width / 2, cell.y + cell.height / 2);
  float sum = 0;
  int count = 0;
  for (int v = cell.y; v < cell.y + cell.height; ++v)
    for (int u = cell.x; u < cell.x + cell.width; ++u) {
      const float value = disparity(v, u);
      if (!(std::abs(value - middle) < kSurface * middle)) continue;
      sum += value;
      ++count;
    }
  return count > 0 ? sum / static_cast<float>(count) : 0;
}

}  // namespace

DepthView thinnedOut(const DepthFrame& frame) {
  DepthView view;
  const cv::Mat1f& disparity = frame.disparity;
  const int longer = std::max(disparity.cols, disparity.rows);
  if (longer == 0) return view;
  const int step = (longer + kMostCells - 1) / kMostCells;
  if (disparity.cols < step || disparity.rows < step) return view;
  view.columns = disparity.cols / step;
  view.rows = disparity.rows / step;
  view.fx = frame.camera.fx / step;
  view.fy = frame.camera.fy / step;
  const double middle = 0.5 * (step - 1);
  view.cx = (frame.camera.cx - middle) / step;
  view.cy = (frame.camera.cy - middle) / step;
  view.depth.reserve(static_cast<std::size_t>(view.columns) * static_cast<std::size_t>(view.rows));
  for (int row = 0; row < view.rows; ++row)
    for (int column = 0; column < view.columns; ++column) {
      const float value = surfaceDisparity(disparity, {column * step, row * step, step, step});
      const double depth = value > 0 ? frame.camera.depth(value) : 0;
      view.depth.push_back(isWithin(depth, limits::kViewDepth) ? static_cast<float>(depth) : 0.0F);
    }
  return view;
}

}  // namespace cabinet_articulation::core
