// SPDX-License-Identifier: BSD-3-Clause
#include "ros/transforms/transform_lookup.h"

#include <cmath>
#include <stdexcept>

#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/ros/pose_conversions.h"

namespace cabinet_articulation {
namespace {

// tf2 returns the newest transform as it was sent. Once a later one is known it interpolates, which changes the last bits even
// at the first one's stamp. Rounding to 2^-30 (a nanometre) makes both the same, and is far below every measurement.
double rounded(double value) {
  constexpr double kStepsPerUnit = 1 << 30;
  return std::round(value * kStepsPerUnit) / kStepsPerUnit;
}

void requireSane(const geometry_msgs::TransformStamped& message) {
  requireStamp("stamp", message.header.stamp);
  const geometry_msgs::Vector3& t = message.transform.translation;
  core::requireWithin("translation", Eigen::Vector3d(t.x, t.y, t.z), core::limits::kSensed);
  const geometry_msgs::Quaternion& q = message.transform.rotation;
  core::requireWithin("length of rotation", Eigen::Vector4d(q.x, q.y, q.z, q.w).norm(), core::limits::kUnitLength);
}

}  // namespace

void addTransforms(const tf2_msgs::TFMessage& message, bool is_static, tf2::BufferCore* buffer) {
  std::string wrong;
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    try {
      requireSane(transform);
      buffer->setTransform(transform, "tf", is_static);
    } catch (const std::exception& error) {
      wrong = "the transform from '" + transform.child_frame_id + "' to '" + transform.header.frame_id + "': " + error.what();
    }
  }
  if (!wrong.empty()) throw std::invalid_argument(wrong);
}

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
