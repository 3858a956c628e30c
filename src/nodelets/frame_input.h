// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cv_bridge/cv_bridge.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <stereo_msgs/DisparityImage.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cabinet_articulation/stereo/depth_frame.h"
#include "pair_matcher.h"
#include "recent_messages.h"
#include "settings.h"
#include "watched_subscriber.h"

namespace cabinet_articulation {

/// The messages of one measurement. Either `disparity` or `depth` is there; both images or none.
struct FrameMessages {
  stereo_msgs::DisparityImageConstPtr disparity;
  sensor_msgs::ImageConstPtr depth;
  sensor_msgs::CameraInfoConstPtr info, right_info;
  sensor_msgs::ImageConstPtr left, right;

  const std_msgs::Header& header() const { return disparity ? disparity->header : depth->header; }
};

/// The same as the core sees it. The views stay valid as long as this object and the messages live.
struct FrameViews {
  core::DepthFrame frame;
  cv_bridge::CvImageConstPtr left, right, depth;
};

/// Collects disparity (or depth), camera and images, in whatever order they arrive. CameraInfos hardly change, so the
/// newest one serves. A disparity waits for its images as long as images come in at all, at most until the next one.
class FrameInput {
 public:
  using Callback = std::function<void(const FrameMessages&)>;

  FrameInput(const FrameInputConfig& config, const SyncConfig& sync);

  /// `complete` (may be empty) is called for every frame.
  void subscribe(ros::NodeHandle& nh, const Callback& complete);
  void unsubscribe();

  /// The messages of the frame measured at `stamp`, if they are (still) here.
  std::optional<FrameMessages> find(const ros::Time& stamp) const;

  /// Throws std::invalid_argument naming the topic, what is wrong and what was expected.
  FrameViews view(const FrameMessages& messages) const;

  /// The inputs that must not be silent.
  std::vector<const WatchedSubscriber*> required() const { return {&frame_topic_, &info_topic_}; }
  const std::string& topic() const { return frame_topic_.topic(); }

 private:
  // A stage may lag behind its input by this many frames before it misses the images of a frame (1 s at 15 Hz).
  static constexpr size_t kDepth = 16;

  void frameArrived(const ros::Time& stamp);
  void imageArrived();
  bool imagesMayStillCome(const ros::Time& stamp) const;
  void deliver();

  FrameInputConfig config_;
  double sync_tolerance_;
  Callback complete_;
  std::optional<ros::Time> waiting_;  ///< the newest frame, while its images are missing
  RecentMessages<stereo_msgs::DisparityImage> disparities_{kDepth};
  RecentMessages<sensor_msgs::Image> depths_{kDepth}, left_{kDepth}, right_{kDepth};
  sensor_msgs::CameraInfoConstPtr info_, right_info_;
  WatchedSubscriber frame_topic_, info_topic_, right_info_topic_, left_topic_, right_topic_;
};

}  // namespace cabinet_articulation
