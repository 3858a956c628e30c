// SPDX-License-Identifier: BSD-3-Clause
#include "kinds/upright.h"

#include <cmath>
#include <utility>

#include "articulation/paths/arc.h"

namespace cabinet_articulation::core {

Eigen::Matrix3d turnOf(int k) { return rotationFromVector(Eigen::Vector3d(0, 0, k * M_PI / 2)); }

int uprightDescription(const Eigen::Matrix3d& front) {
  const double facing = std::abs(front(2, 2));
  const Eigen::Vector3d up = facing < M_SQRT1_2 ? Eigen::Vector3d(Eigen::Vector3d::UnitZ()) : Eigen::Vector3d(0, -1, 0);
  int best = 0;
  for (int k = 1; k < kDescriptionsOfASide; ++k)
    if (up.dot(front * turnOf(k).col(1)) > up.dot(front * turnOf(best).col(1))) best = k;
  return best;
}

JointShape described(const JointShape& shape, int k) {
  if (k == 0) return shape;
  JointShape result = shape;
  result.frame = turnOf(k).transpose() * shape.frame;
  if (k % 2 != 0) std::swap(result.width, result.height);
  return result;
}

}  // namespace cabinet_articulation::core
