// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

#include "cabinet_articulation/geometry/rectangle.h"

namespace cabinet_articulation::core {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// One accepted rectangle of one frame.
struct DetectedRectangle {
  Rectangle rectangle;                              ///< in the left optical frame (trackers: in the fixed frame)
  Matrix6d covariance = Matrix6d::Zero();           ///< x y z [m], rotations about x y z [rad], in that frame's axes (REP 103)
  double precision = 0;                             ///< Eq. (4)
  double recall = 0;                                ///< Eq. (5), of the connected region
  std::array<float, 4> edge_support{{0, 0, 0, 0}};  ///< [0..1] observed share of the edges, in the order of `Edge`
  bool hollow = false;                              ///< a frame around a hole, as that of a glass door
  int region = 0;                                   ///< index of the plane region it was found in
};

}  // namespace cabinet_articulation::core
