// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

namespace cabinet_articulation::core {

/// A rectified pair of pinhole cameras. The frame is the left optical frame: x right, y down, z forward.
/// A depth camera is described by the same model: its depth is turned into the disparity of a virtual right camera.
struct StereoCamera {
  int width = 0;             ///< [px]
  int height = 0;            ///< [px]
  double fx = 0;             ///< [px]
  double fy = 0;             ///< [px]
  double cx = 0;             ///< [px] principal point of the left camera
  double cy = 0;             ///< [px]
  double baseline = 0;       ///< [m] positive, right camera at +x
  double cx_difference = 0;  ///< [px] cx of the left minus cx of the right camera

  /// From the 3x4 projection matrices P of the two CameraInfos (row-major). Throws std::invalid_argument that names the element,
  /// its value and what was expected. Focal lengths must be positive, the right P[3] = -fx * baseline must be negative, and all
  /// within geometry/limits.h.
  static StereoCamera fromProjections(int width, int height, const std::array<double, 12>& P_left,
                                      const std::array<double, 12>& P_right);

  /// A depth camera with intrinsics K (row-major 3x3) and a virtual baseline. Throws like fromProjections.
  static StereoCamera fromDepthCamera(int width, int height, const std::array<double, 9>& K, double virtual_baseline);

  /// Within geometry/limits.h; what the two above return is.
  bool isSane() const;

  /// fx * baseline: disparity [px] = focalBaseline / depth [m]. Disparities are free of cx_difference throughout.
  double focalBaseline() const { return fx * baseline; }

  double depth(double disparity) const { return focalBaseline() / disparity; }
  double disparity(double depth) const { return focalBaseline() / depth; }

  /// The 3-D point of a left pixel with a positive disparity.
  Eigen::Vector3d point(double u, double v, double disparity) const;

  /// The ray through a left pixel, with z = 1.
  Eigen::Vector3d ray(double u, double v) const { return {(u - cx) / fx, (v - cy) / fy, 1.0}; }

  /// The left pixel of a point with positive z.
  Eigen::Vector2d project(const Eigen::Vector3d& p) const { return {fx * p.x() / p.z() + cx, fy * p.y() / p.z() + cy}; }
};

}  // namespace cabinet_articulation::core
