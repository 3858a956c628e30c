// SPDX-License-Identifier: BSD-3-Clause
#include "nodelets/input/frame_input.h"

namespace cabinet_articulation {
namespace {

FrameTopics resolved(const ros::NodeHandle& nh, FrameTopics topics) {
  for (std::string* topic : {&topics.frame, &topics.info, &topics.right_info, &topics.left, &topics.right})
    if (!topic->empty()) *topic = nh.resolveName(*topic);
  return topics;
}

}  // namespace

FrameInput::FrameInput(const ros::NodeHandle& nh, const ros::NodeHandle& parameters, const FrameInputConfig& config,
                       const SyncConfig& sync, const ImageTransportConfig& transport, const CallbackGuard& guard)
    : nh_(nh),
      parameters_(parameters),
      input_(config.input),
      transport_(transport.image_transport),
      guard_(guard),
      assembler_(
          config, sync, resolved(nh, FrameTopics::below("", config.input)),
          [this](const FrameMessages& frame) {
            if (complete_) complete_(frame);
          },
          [this](const std::string& why) {
            if (left_out_) left_out_(why);
          }) {
  requireInstalled(nh, transport_);
}

void FrameInput::subscribe(const FrameAssembler::Callback& complete, const FrameAssembler::LeftOut& left_out) {
  complete_ = complete;
  left_out_ = left_out;
  const FrameTopics topics = FrameTopics::below("", input_);
  info_topic_.subscribe<sensor_msgs::CameraInfo>(nh_, topics.info, guard_,
                                                 [this](const auto& info) { assembler_.addInfo(info); });
  if (input_ == "depth") {
    frame_topic_.subscribeImage(nh_, parameters_, topics.frame, transport_, guard_,
                                [this](const auto& depth) { assembler_.addDepth(depth); });
    return;
  }
  right_info_topic_.subscribe<sensor_msgs::CameraInfo>(nh_, topics.right_info, guard_,
                                                       [this](const auto& info) { assembler_.addRightInfo(info); });
  left_topic_.subscribeImage(nh_, parameters_, topics.left, transport_, guard_,
                             [this](const auto& image) { assembler_.addLeft(image); });
  right_topic_.subscribeImage(nh_, parameters_, topics.right, transport_, guard_,
                              [this](const auto& image) { assembler_.addRight(image); });
  frame_topic_.subscribe<stereo_msgs::DisparityImage>(nh_, topics.frame, guard_,
                                                      [this](const auto& disparity) { addDisparity(disparity); });
}

void FrameInput::addDisparity(const stereo_msgs::DisparityImageConstPtr& disparity) {
  if (left_topic_.publishers() > 0 && right_topic_.publishers() > 0) assembler_.expectImages();
  if (right_info_topic_.publishers() > 0) assembler_.expectRightInfo();
  assembler_.addDisparity(disparity);
}

void FrameInput::unsubscribe() {
  for (WatchedSubscriber* topic : {&frame_topic_, &info_topic_, &right_info_topic_, &left_topic_, &right_topic_})
    topic->shutdown();
  assembler_.clear();
}

}  // namespace cabinet_articulation
