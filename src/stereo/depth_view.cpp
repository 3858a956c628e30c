// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/stereo/depth_view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cabinet_articulation/geometry/limits.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kMostCells = 80;  ///< along the longer side (ours: 19 kB a view, and 40 cells on a small drawer's front at 1.5 m)

/// By the exchanges that leave the middle of nine in its place (J. Smith, in XILINX XCELL 23, 1996): no branches.
float medianOfNine(std::array<float, 9> v) {
  const auto order = [&v](int low, int high) {
    const float least = std::min(v[low], v[high]);
    v[high] = std::max(v[low], v[high]);
    v[low] = least;
  };
  for (const int row : {0, 3, 6}) order(row + 1, row + 2);
  for (const int row : {0, 3, 6}) order(row, row + 1);
  for (const int row : {0, 3, 6}) order(row + 1, row + 2);
  order(0, 3), order(5, 8), order(4, 7), order(3, 6), order(1, 4), order(2, 5), order(4, 7);
  order(4, 2), order(6, 4), order(4, 2);
  return v[4];
}

/// Of the nine pixels around u, v; 0 unless most of them were measured.
float medianDisparity(const cv::Mat1f& disparity, int u, int v) {
  std::array<float, 9> values;
  std::size_t count = 0;
  for (int y = std::max(v - 1, 0); y <= std::min(v + 1, disparity.rows - 1); ++y)
    for (int x = std::max(u - 1, 0); x <= std::min(u + 1, disparity.cols - 1); ++x) {
      values[count] = disparity(y, x);
      count += isValidDisparity(values[count]) ? 1 : 0;
    }
  if (count == values.size()) return medianOfNine(values);
  if (2 * count <= values.size()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

/// The mean over a cell of what belongs to the surface in its middle.
struct Surface {
  float middle = 0, sum = 0;
  int count = 0;

  /// Without a branch, which noise would decide.
  void add(float disparity) {
    constexpr float kSurface = 0.015F;  // share of the disparity: 4 sigma of a Kinect's noise at 2 m
    const bool is_near = std::abs(disparity - middle) < kSurface * middle;
    sum += is_near ? disparity : 0;
    count += is_near ? 1 : 0;
  }

  /// 0 unless the surface was measured.
  float mean() const { return count > 0 ? sum / static_cast<float>(count) : 0; }
};

/// Of a row of square cells, whose uppermost pixels are in row `top`. Steps and noise of the depth are larger than what is to be
/// told from it.
void measureSurfaces(const cv::Mat1f& disparity, int top, int step, std::vector<Surface>* cells) {
  for (size_t i = 0; i < cells->size(); ++i)
    (*cells)[i] = {medianDisparity(disparity, static_cast<int>(i) * step + step / 2, top + step / 2), 0, 0};
  for (int v = top; v < top + step; ++v) {
    const float* pixel = disparity[v];
    for (Surface& cell : *cells)
      for (const float* const end = pixel + step; pixel < end; ++pixel) cell.add(*pixel);
  }
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
  std::vector<Surface> cells(view.columns);
  for (int row = 0; row < view.rows; ++row) {
    measureSurfaces(disparity, row * step, step, &cells);
    for (const Surface& cell : cells) {
      const float value = cell.mean();
      const double depth = value > 0 ? frame.camera.depth(value) : 0;
      view.depth.push_back(isWithin(depth, limits::kViewDepth) ? static_cast<float>(depth) : 0.0F);
    }
  }
  return view;
}

}  // namespace cabinet_articulation::core
