// SPDX-License-Identifier: BSD-3-Clause
#include "transform_source.h"

#include <tf2_eigen/tf2_eigen.h>

#include <stdexcept>

namespace cabinet_articulation {

Eigen::Isometry3d TransformSource::lookup(const std::string& target, const std::string& source, const ros::Time& stamp,
                                          double patience) {
  if (target == source) return Eigen::Isometry3d::Identity();
  if (!listener_) {
    buffer_ = std::make_unique<tf2_ros::Buffer>();
    listener_ = std::make_unique<tf2_ros::TransformListener>(*buffer_);
  }
  if (clock_jump_(stamp)) buffer_->clear();
  std::string why;
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(patience);
  while (ros::ok() && !buffer_->canTransform(target, source, stamp, &why) && ros::WallTime::now() < deadline)
    ros::WallDuration(0.002).sleep();
  try {
    return tf2::transformToEigen(buffer_->lookupTransform(target, source, stamp));
  } catch (const tf2::TransformException& error) {
    throw std::runtime_error("no transform from '" + source + "' to '" + target + "': " + error.what());
  }
}

}  // namespace cabinet_articulation
