// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/ros/pose_conversions.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "cabinet_articulation/geometry/limits.h"
#include "geometry/message_precision.h"

namespace cabinet_articulation {
namespace {

using RowMajor6d = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

constexpr double kQuaternionTolerance = 0.01;

}  // namespace

geometry_msgs::Point toPoint(const Eigen::Vector3d& p) {
  geometry_msgs::Point message;
  message.x = p.x();
  message.y = p.y();
  message.z = p.z();
  return message;
}

geometry_msgs::Vector3 toVector(const Eigen::Vector3d& v) {
  geometry_msgs::Vector3 message;
  message.x = v.x();
  message.y = v.y();
  message.z = v.z();
  return message;
}

geometry_msgs::Pose toMessage(const Eigen::Isometry3d& pose) {
  geometry_msgs::Pose message;
  message.position = toPoint(pose.translation());
  const Eigen::Quaterniond q = core::toQuaternion(pose.linear());
  message.orientation.x = q.x();
  message.orientation.y = q.y();
  message.orientation.z = q.z();
  message.orientation.w = q.w();
  return message;
}

Eigen::Isometry3d fromMessage(const geometry_msgs::Pose& message) {
  const Eigen::Vector3d p = fromMessage(message.position);
  const Eigen::Quaterniond q(message.orientation.w, message.orientation.x, message.orientation.y, message.orientation.z);
  core::requireWithin("position", p, core::limits::kFromOrigin);
  if (!(std::abs(q.norm() - 1) <= kQuaternionTolerance)) {
    std::ostringstream text;
    text << "orientation has length " << q.norm() << ", expected a unit quaternion";
    throw std::invalid_argument(text.str());
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = core::toRotation(q);
  pose.translation() = p;
  return pose;
}

Eigen::Vector3d fromMessage(const geometry_msgs::Point& p) { return {p.x, p.y, p.z}; }

Eigen::Vector3d fromMessage(const geometry_msgs::Vector3& v) { return {v.x, v.y, v.z}; }

boost::array<double, 36> toMessage(const core::Matrix6d& covariance) {
  boost::array<double, 36> message;
  Eigen::Map<RowMajor6d>(message.data()) = covariance;
  return message;
}

core::Matrix6d fromMessage(const boost::array<double, 36>& covariance) { return Eigen::Map<const RowMajor6d>(covariance.data()); }

ros::Time toStamp(double seconds) {
  if (!(seconds > 0)) return {};
  if (seconds >= ros::TIME_MAX.toSec()) return ros::TIME_MAX;
  return ros::Time().fromSec(seconds);
}

void requireStamp(const char* element, const ros::Time& stamp) {
  if (stamp.sec <= core::limits::kLastSecond) return;
  throw std::invalid_argument(std::string(element) + " is " + std::to_string(stamp.sec) + " s, expected " +
                              std::to_string(core::limits::kLastSecond) + " s at most: time of ROS ends soon after");
}

double secondsBetween(const ros::Time& earlier, const ros::Time& later) {
  return 1e-9 * static_cast<double>(static_cast<std::int64_t>(later.toNSec()) - static_cast<std::int64_t>(earlier.toNSec()));
}

}  // namespace cabinet_articulation
