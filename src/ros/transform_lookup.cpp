// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/ros/transform_lookup.h"

#include <cmath>

namespace cabinet_articulation {
namespace {

// tf2 returns the newest transform as it was sent. Once a later one is known it interpolates, which changes the last bits even
// at the first one's stamp. Rounding to 2^-30 (a nanometre) makes both the same, and is far below every measurement.
double rounded(double value) {
  constexpr double kStepsPerUnit = 1 << 30;
  return std::round(value * kStepsPerUnit) / kStepsPerUnit;
}

}  // namespace

std::string tfName(const std::string& frame) { return !frame.empty() && frame[0] == '/' ? frame.substr(1) : frame; }

Eigen::Isometry3d lookupTransform(const tf2::BufferCore& buffer, const std::string& target, const std::string& source,
                                  const ros::Time& stamp) {
  if (tfName(target) == tfName(source)) return Eigen::Isometry3d::Identity();
  const geometry_msgs::Transform transform = buffer.lookupTransform(tfName(target), tfName(source), stamp).transform;
  const geometry_msgs::Vector3& t = transform.translation;
  const geometry_msgs::Quaternion& q = transform.rotation;
  const Eigen::Quaterniond rotation(rounded(q.w), rounded(q.x), rounded(q.y), rounded(q.z));
  return Eigen::Translation3d(rounded(t.x), rounded(t.y), rounded(t.z)) * Eigen::Isometry3d(rotation.normalized());
}

}  // namespace cabinet_articulation
