// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/message_precision.h"

#include <algorithm>
#include <cmath>

namespace cabinet_articulation::core {

Eigen::Quaterniond toQuaternion(const Eigen::Matrix3d& R) { return Eigen::Quaterniond(R).normalized(); }

Eigen::Matrix3d toRotation(const Eigen::Quaterniond& q) { return q.normalized().toRotationMatrix(); }

Eigen::Isometry3d asSent(const Eigen::Isometry3d& pose) {
  Eigen::Isometry3d sent = Eigen::Isometry3d::Identity();
  sent.linear() = toRotation(toQuaternion(pose.linear()));
  sent.translation() = pose.translation();
  return sent;
}

double asSent(double stamp) {
  constexpr double kNanoseconds = 1e9;
  const double seconds = std::floor(std::max(stamp, 0.0));
  return seconds + std::round((std::max(stamp, 0.0) - seconds) * kNanoseconds) * 1e-9;
}

bool isSameStamp(double a, double b) {
  constexpr double kLost = 1e-6;  // [s] that a double of today's seconds may lose: 2e-7
  return std::abs(a - b) <= kLost;
}

}  // namespace cabinet_articulation::core
