// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace cabinet_articulation::core {

/// The covariance of a position and a rotation vector, or of two other vectors, as seen from a frame that is turned by R.
inline Eigen::Matrix<double, 6, 6> turned(const Eigen::Matrix<double, 6, 6>& covariance, const Eigen::Matrix3d& R) {
  Eigen::Matrix<double, 6, 6> turn = Eigen::Matrix<double, 6, 6>::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = R;
  // Assigned, so that Eigen evaluates one product after the other.
  Eigen::Matrix<double, 6, 6> result;
  result = turn * covariance * turn.transpose();
  return result;
}

}  // namespace cabinet_articulation::core
