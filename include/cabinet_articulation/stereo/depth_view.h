// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "cabinet_articulation/stereo/depth_frame.h"

namespace cabinet_articulation::core {

/// A frame's depth on a coarse grid of pixels, and where the camera was. It is enough to tell whether a surface is where it
/// should be, and small enough to be kept for many frames.
struct DepthView {
  double stamp = 0;           ///< [s]
  int columns = 0, rows = 0;  ///< of the grid; 0: nothing was seen
  double fx = 0, fy = 0;      ///< [cells] focal lengths
  double cx = 0, cy = 0;      ///< [cells] principal point; the middle of the first cell is 0, 0
  std::vector<float> depth;   ///< [m] along the optical axis, row by row; 0: nothing was measured
  Eigen::Isometry3d T_fixed_camera = Eigen::Isometry3d::Identity();

  bool empty() const { return depth.empty(); }

  /// The ray through a cell, with z = 1, in the camera's frame.
  Eigen::Vector3d ray(int column, int row) const { return {(column - cx) / fx, (row - cy) / fy, 1}; }

  float at(int column, int row) const {
    return depth[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)];
  }
};

/// At most 80 columns, or rows if the image is higher than wide. A cell is 8 px of a 640 px wide image, which is 3 cm at 2 m. A
/// cell has the mean of the surface in its middle. The stamp is left to the caller; the fixed frame is the camera's.
DepthView thinnedOut(const DepthFrame& frame);

}  // namespace cabinet_articulation::core
