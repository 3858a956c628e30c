// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>

#include <functional>
#include <map>
#include <string>

#include "ros/images/rectifier.h"
#include "ros/input/frame_assembler.h"
#include "stereo/pair_watch.h"
#include "tools/input/bag_input.h"
#include "tools/input/skipped_frames.h"

namespace cabinet_articulation {

/// What is in a bag, and how it is to be read.
struct FrameBagOptions {
  InputOptions input;
  FrameInputConfig frames;  ///< but for the kind of input
  SyncConfig sync;
  bool leave_out_unlit = true;  ///< as StereoConfig
};

/// The frames in a bag: rectified stereo pairs (without disparities yet), disparities with their images, or depth images, put
/// together as the nodelets do. Nothing is dropped but what has no counterpart or cannot be used.
class FrameBag {
 public:
  /// The header is that of the left image, the disparity or the depth image.
  using Callback = std::function<void(const std_msgs::Header&, const FrameViews&)>;

  /// Throws as chooseInput, and std::runtime_error that says in words what is wrong: no such
  /// file, not a bag or truncated.
  FrameBag(const std::string& path, const FrameBagOptions& options);

  /// Calls back for every frame in the order of the bag. Throws std::runtime_error where the bag cannot be read on.
  void forEachFrame(const Callback& callback, SkippedFrames* skipped);

  const rosbag::Bag& bag() const { return bag_; }
  const BagInput& input() const { return input_; }

  /// Depth images, disparities or left images.
  size_t expectedFrames() const;

  /// So many of them were read, also those that gave no frame.
  size_t framesRead() const { return frames_read_; }

 private:
  using Infos = std::map<ros::Time, sensor_msgs::CameraInfoConstPtr>;
  using ImagePair = PairMatcher<sensor_msgs::Image>::Pair;

  void forEachPair(const Callback& callback, SkippedFrames* skipped);
  void forEachDepth(const Callback& callback, SkippedFrames* skipped);
  /// Null, and counted, for an image that cannot be decoded.
  sensor_msgs::ImageConstPtr readImage(const rosbag::MessageInstance& instance, SkippedFrames* skipped) const;
  void play(FrameAssembler* assembler, const std::function<void(const ros::Time&)>& before_frame, SkippedFrames* skipped);
  Infos readInfos(const std::string& topic) const;
  FrameViews viewPair(const ImagePair& pair, const sensor_msgs::CameraInfo& left, const sensor_msgs::CameraInfo& right);

  const std::string path_;
  const FrameBagOptions options_;
  rosbag::Bag bag_;
  BagInput input_;
  Rectifier rectifiers_[2];
  core::ProjectorWatch projector_;
  size_t frames_read_ = 0;
};

}  // namespace cabinet_articulation
