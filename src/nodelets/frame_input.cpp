// SPDX-License-Identifier: BSD-3-Clause
#include "frame_input.h"

#include <stdexcept>

#include "cabinet_articulation/ros/image_conversions.h"
#include "cabinet_articulation/stereo/block_matcher.h"

namespace cabinet_articulation {

FrameInput::FrameInput(const FrameInputConfig& config, const SyncConfig& sync)
    : config_(config), sync_tolerance_(sync.tolerance()) {}

void FrameInput::subscribe(ros::NodeHandle& nh, const Callback& complete) {
  complete_ = complete;
  if (config_.input == "depth") {
    info_topic_.subscribe<sensor_msgs::CameraInfo>(nh, "depth/camera_info", [this](const auto& info) { info_ = info; });
    frame_topic_.subscribe<sensor_msgs::Image>(nh, "depth/image", [this](const auto& depth) {
      depths_.add(depth);
      frameArrived(depth->header.stamp);
    });
    return;
  }
  info_topic_.subscribe<sensor_msgs::CameraInfo>(nh, "left/camera_info", [this](const auto& info) { info_ = info; });
  right_info_topic_.subscribe<sensor_msgs::CameraInfo>(nh, "right/camera_info", [this](const auto& info) { right_info_ = info; });
  left_topic_.subscribe<sensor_msgs::Image>(nh, "left/image_rect", [this](const auto& image) {
    left_.add(image);
    imageArrived();
  });
  right_topic_.subscribe<sensor_msgs::Image>(nh, "right/image_rect", [this](const auto& image) {
    right_.add(image);
    imageArrived();
  });
  frame_topic_.subscribe<stereo_msgs::DisparityImage>(nh, "disparity", [this](const auto& disparity) {
    disparities_.add(disparity);
    frameArrived(disparity->header.stamp);
  });
}

void FrameInput::unsubscribe() {
  for (WatchedSubscriber* topic : {&frame_topic_, &info_topic_, &right_info_topic_, &left_topic_, &right_topic_})
    topic->shutdown();
  waiting_.reset();
  disparities_.clear();
  depths_.clear();
  left_.clear();
  right_.clear();
  info_.reset();
  right_info_.reset();
}

void FrameInput::frameArrived(const ros::Time& stamp) {
  if (waiting_) deliver();  // its images never came
  waiting_ = stamp;
  if (!imagesMayStillCome(stamp)) deliver();
}

void FrameInput::imageArrived() {
  if (waiting_ && !imagesMayStillCome(*waiting_)) deliver();
}

bool FrameInput::imagesMayStillCome(const ros::Time& stamp) const {
  if (left_.empty() || right_.empty()) return false;
  return !left_.find(stamp, 0) || !right_.find(stamp, sync_tolerance_);
}

void FrameInput::deliver() {
  const auto messages = find(*waiting_);
  waiting_.reset();
  if (messages && complete_) complete_(*messages);
}

std::optional<FrameMessages> FrameInput::find(const ros::Time& stamp) const {
  FrameMessages messages;
  messages.disparity = disparities_.find(stamp);
  messages.depth = depths_.find(stamp);
  messages.info = info_;
  messages.right_info = right_info_;
  if (!info_ || (!messages.disparity && !messages.depth)) return {};
  const sensor_msgs::ImageConstPtr left = left_.find(stamp);
  const sensor_msgs::ImageConstPtr right = right_.find(stamp, sync_tolerance_);
  if (left && right) {
    messages.left = left;
    messages.right = right;
  }
  return messages;
}

FrameViews FrameInput::view(const FrameMessages& messages) const {
  FrameViews views;
  if (messages.depth) {
    const core::StereoCamera camera = toDepthCamera(*messages.info, info_topic_.topic(), config_.virtual_baseline);
    views.depth = toImage(messages.depth, frame_topic_.topic());
    try {
      views.frame = core::frameFromDepth(views.depth->image, camera);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(frame_topic_.topic() + ": " + error.what());
    }
    return views;
  }
  const core::StereoCamera camera = toDisparityCamera(*messages.disparity, frame_topic_.topic(), *messages.info,
                                                      info_topic_.topic(), messages.right_info.get());
  views.frame.camera = camera;
  views.frame.disparity = toDisparities(*messages.disparity, frame_topic_.topic(), camera);
  if (!messages.left) return views;
  views.left = toMono(messages.left, left_topic_.topic());
  views.right = toMono(messages.right, right_topic_.topic());
  requireSize(views.left->image, camera, left_topic_.topic());
  requireSize(views.right->image, camera, right_topic_.topic());
  views.frame.left = views.left->image;
  views.frame.right = views.right->image;
  return views;
}

}  // namespace cabinet_articulation
