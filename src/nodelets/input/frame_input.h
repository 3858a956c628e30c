// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include <optional>
#include <string>
#include <vector>

#include "nodelets/input/watched_subscriber.h"
#include "ros/input/frame_assembler.h"

namespace cabinet_articulation {

/// Subscribes to what a FrameAssembler puts together.
class FrameInput {
 public:
  /// What a callback throws goes to the guard.
  /// Throws std::runtime_error for a transport that is not installed.
  FrameInput(const ros::NodeHandle& nh, const ros::NodeHandle& parameters, const FrameInputConfig& config, const SyncConfig& sync,
             const ImageTransportConfig& transport, const CallbackGuard& guard);

  /// The callbacks (may be empty) are those of FrameAssembler.
  void subscribe(const FrameAssembler::Callback& complete, const FrameAssembler::LeftOut& left_out = {});
  void unsubscribe();

  /// As those of FrameAssembler.
  std::optional<FrameMessages> find(const ros::Time& stamp) const { return assembler_.find(stamp); }
  FrameViews view(const FrameMessages& messages) const { return assembler_.view(messages); }

  /// The inputs that must not be silent.
  std::vector<const WatchedSubscriber*> required() const { return {&frame_topic_, &info_topic_}; }
  const std::string& topic() const { return assembler_.topics().frame; }

 private:
  void addDisparity(const stereo_msgs::DisparityImageConstPtr& disparity);

  ros::NodeHandle nh_, parameters_;
  std::string input_, transport_;
  CallbackGuard guard_;
  FrameAssembler::Callback complete_;
  FrameAssembler::LeftOut left_out_;
  FrameAssembler assembler_;
  WatchedSubscriber frame_topic_, info_topic_, right_info_topic_, left_topic_, right_topic_;
};

}  // namespace cabinet_articulation
