// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace cabinet_articulation::core {

/// The plane z = c(0) + c(1) x + c(2) y through points of a front's own frame.
struct SurfacePlane {
  Eigen::Vector3d c = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// Least squares with Tukey's weights about the median. Nothing for less points than make a plane certain.
std::optional<SurfacePlane> fitSurface(const std::vector<Eigen::Vector3d>& points);

}  // namespace cabinet_articulation::core
