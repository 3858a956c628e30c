// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>

#include <functional>
#include <map>
#include <string>

#include "ros/frame_assembler.h"
#include "tools/bag_input.h"
#include "tools/rectifier.h"
#include "tools/skipped_frames.h"

namespace cabinet_articulation {

/// The frames in a bag: rectified stereo pairs (without disparities yet), disparities with their images, or depth images, put
/// together as the nodelets do. Nothing is dropped but what has no counterpart or cannot be used.
class FrameBag {
 public:
  /// The header is that of the left image, the disparity or the depth image.
  using Callback = std::function<void(const std_msgs::Header&, const FrameViews&)>;

  /// `input` and `camera` as in chooseInput. Throws as that, and std::runtime_error that says in words what is wrong: no such
  /// file, not a bag or truncated.
  FrameBag(const std::string& path, const std::string& input, const std::string& camera);

  /// Calls back for every frame in the order of the bag. Throws std::runtime_error where the bag cannot be read on.
  void forEachFrame(const Callback& callback, SkippedFrames* skipped);

  const rosbag::Bag& bag() const { return bag_; }

 private:
  using Infos = std::map<ros::Time, sensor_msgs::CameraInfoConstPtr>;
  using ImagePair = PairMatcher<sensor_msgs::Image>::Pair;

  void forEachPair(const Callback& callback, SkippedFrames* skipped);
  void forEachDepth(const Callback& callback, SkippedFrames* skipped);
  void play(FrameAssembler* assembler, const std::function<void(const ros::Time&)>& before_frame) const;
  Infos readInfos(const std::string& topic) const;
  FrameViews viewPair(const ImagePair& pair, const sensor_msgs::CameraInfo& left, const sensor_msgs::CameraInfo& right);

  std::string path_;
  rosbag::Bag bag_;
  BagInput input_;
  Rectifier rectifiers_[2];
};

}  // namespace cabinet_articulation
