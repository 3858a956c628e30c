// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <functional>
#include <map>
#include <string>

#include "skipped_frames.h"

namespace cabinet_articulation {

/// Two images of one moment with the cameras that took them.
struct StereoPair {
  sensor_msgs::ImageConstPtr left, right;
  sensor_msgs::CameraInfoConstPtr left_info, right_info;
};

/// The stereo pairs in a bag: <camera>/{left,right}/{image_rect or image_raw, camera_info}. Nothing is dropped but what
/// has no counterpart of exactly the same stamp.
class StereoBag {
 public:
  /// Throws std::runtime_error that says in words what is wrong: no such file, not a bag, truncated, or which topics are
  /// missing and which there are.
  StereoBag(const std::string& path, const std::string& camera);

  /// Calls back for every pair in the order of the bag. Throws std::runtime_error where the bag cannot be read on.
  void forEachPair(const std::function<void(const StereoPair&)>& callback, SkippedFrames* skipped) const;

  const rosbag::Bag& bag() const { return bag_; }
  const std::string& imageTopic(int side) const { return image_topics_[side]; }
  const std::string& infoTopic(int side) const { return info_topics_[side]; }
  bool rectified() const { return rectified_; }

 private:
  using Infos = std::map<ros::Time, sensor_msgs::CameraInfoConstPtr>;

  void chooseTopics(const std::string& camera);
  Infos readInfos(int side) const;

  rosbag::Bag bag_;
  std::string path_;
  std::string image_topics_[2], info_topics_[2];
  bool rectified_ = false;
};

}  // namespace cabinet_articulation
