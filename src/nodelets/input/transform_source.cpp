// SPDX-License-Identifier: BSD-3-Clause
#include "nodelets/input/transform_source.h"

#include <ros/node_handle.h>
#include <tf2/exceptions.h>

#include <stdexcept>

#include "ros/transforms/transform_lookup.h"

namespace cabinet_articulation {
namespace {

constexpr std::uint32_t kQueue = 100;  // as tf2_ros::TransformListener

}  // namespace

void TransformSource::listen() {
  std::call_once(listening_, [this] {
    ros::NodeHandle nh;
    nh.setCallbackQueue(thread_.queue());
    moving_ = subscribe(nh, "/tf", false);
    static_ = subscribe(nh, "/tf_static", true);
    thread_.start(1);
  });
}

ros::Subscriber TransformSource::subscribe(ros::NodeHandle& nh, const std::string& topic, bool is_static) {
  const boost::function<void(const tf2_msgs::TFMessageConstPtr&)> heard = [=](const tf2_msgs::TFMessageConstPtr& message) {
    guard_(topic, [&] { add(*message, is_static); });
  };
  return nh.subscribe<tf2_msgs::TFMessage>(topic, kQueue, heard);
}

void TransformSource::add(const tf2_msgs::TFMessage& message, bool is_static) {
  const ros::Time now = ros::Time::now();
  if (now < last_heard_) buffer_.clear();
  last_heard_ = now;
  addTransforms(message, is_static, &buffer_);
}

Eigen::Isometry3d TransformSource::lookup(const std::string& target, const std::string& source, const ros::Time& stamp,
                                          double patience) {
  if (tfName(target) == tfName(source)) return Eigen::Isometry3d::Identity();
  listen();
  if (clock_jump_(stamp)) buffer_.clear();
  std::string why;
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(patience);
  while (ros::ok() && !buffer_.canTransform(tfName(target), tfName(source), stamp, &why) && ros::WallTime::now() < deadline)
    ros::WallDuration(0.002).sleep();
  try {
    return lookupTransform(buffer_, target, source, stamp);
  } catch (const tf2::TransformException& error) {
    throw std::runtime_error("no transform from '" + source + "' to '" + target + "': " + error.what());
  }
}

}  // namespace cabinet_articulation
