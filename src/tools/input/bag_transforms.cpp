// SPDX-License-Identifier: BSD-3-Clause
#include "tools/input/bag_transforms.h"

#include <rosbag/view.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <stdexcept>

#include "cabinet_articulation/ros/pose_conversions.h"
#include "ros/transforms/transform_lookup.h"
#include "tools/input/message_stream.h"

namespace cabinet_articulation {
namespace {

constexpr double kLag = 3600;     ///< [s] stamps may lag behind the recording
constexpr double kLongest = 4e6;  ///< [s] 46 days; tf adds it to stamps, which end at limits::kLastSecond and some 57 days

}  // namespace

BagTransforms::BagTransforms(const rosbag::Bag& bag) {
  rosbag::View view(bag, rosbag::TopicQuery(std::vector<std::string>{"/tf", "tf", "/tf_static", "tf_static"}));
  const double length = view.size() > 0 ? secondsBetween(view.getBeginTime(), view.getEndTime()) : 0;
  buffer_ = std::make_unique<tf2::BufferCore>(ros::Duration(std::min(length, kLongest) + kLag));
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = readMessage<tf2_msgs::TFMessage>(instance);
    if (!message) continue;
    const bool is_static = instance.getTopic().find("static") != std::string::npos;
    try {
      addTransforms(*message, is_static, buffer_.get());
    } catch (const std::invalid_argument& error) {
      left_out_ = instance.getTopic() + ": " + error.what();
    }
  }
}

Eigen::Isometry3d BagTransforms::lookup(const std::string& target, const std::string& source, const ros::Time& stamp) const {
  return lookupTransform(*buffer_, target, source, stamp);
}

}  // namespace cabinet_articulation
