// SPDX-License-Identifier: BSD-3-Clause
#include "bag_transforms.h"

#include <rosbag/view.h>
#include <tf2_msgs/TFMessage.h>

#include "cabinet_articulation/ros/transform_lookup.h"

namespace cabinet_articulation {
BagTransforms::BagTransforms(const rosbag::Bag& bag) {
  rosbag::View view(bag, rosbag::TopicQuery(std::vector<std::string>{"/tf", "tf", "/tf_static", "tf_static"}));
  const ros::Duration length = view.size() > 0 ? view.getEndTime() - view.getBeginTime() : ros::Duration(0);
  buffer_ = std::make_unique<tf2::BufferCore>(length + ros::Duration(3600));  // stamps may lag behind the recording
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = instance.instantiate<tf2_msgs::TFMessage>();
    if (!message) continue;
    const bool is_static = instance.getTopic().find("static") != std::string::npos;
    for (const auto& transform : message->transforms) buffer_->setTransform(transform, "bag", is_static);
  }
}

Eigen::Isometry3d BagTransforms::lookup(const std::string& target, const std::string& source, const ros::Time& stamp) const {
  return lookupTransform(*buffer_, target, source, stamp);
}

}  // namespace cabinet_articulation
