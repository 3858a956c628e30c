// SPDX-License-Identifier: BSD-3-Clause
#include "transform_source.h"

#include <stdexcept>

#include "cabinet_articulation/ros/transform_lookup.h"

namespace cabinet_articulation {

void TransformSource::listen() {
  std::call_once(listening_, [this] {
    buffer_ = std::make_unique<tf2_ros::Buffer>();
    listener_ = std::make_unique<tf2_ros::TransformListener>(*buffer_);
  });
}

Eigen::Isometry3d TransformSource::lookup(const std::string& target, const std::string& source, const ros::Time& stamp,
                                          double patience) {
  if (tfName(target) == tfName(source)) return Eigen::Isometry3d::Identity();
  listen();
  if (clock_jump_(stamp)) buffer_->clear();
  std::string why;
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(patience);
  while (ros::ok() && !buffer_->canTransform(tfName(target), tfName(source), stamp, &why) && ros::WallTime::now() < deadline)
    ros::WallDuration(0.002).sleep();
  try {
    return lookupTransform(*buffer_, target, source, stamp);
  } catch (const tf2::TransformException& error) {
    throw std::runtime_error("no transform from '" + source + "' to '" + target + "': " + error.what());
  }
}

}  // namespace cabinet_articulation
