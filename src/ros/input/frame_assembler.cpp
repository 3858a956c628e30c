// SPDX-License-Identifier: BSD-3-Clause
#include "ros/input/frame_assembler.h"

#include <algorithm>
#include <stdexcept>

#include "cabinet_articulation/ros/image_conversions.h"
#include "cabinet_articulation/stereo/block_matcher.h"

namespace cabinet_articulation {
namespace {

template <class Item>
void addBounded(const Item& item, size_t capacity, std::deque<Item>* items) {
  items->push_back(item);
  if (items->size() > capacity) items->pop_front();
}

sensor_msgs::CameraInfoConstPtr infoAt(const RecentMessages<sensor_msgs::CameraInfo>& infos, const ros::Time& stamp) {
  const sensor_msgs::CameraInfoConstPtr own = infos.find(stamp);
  return own ? own : infos.newest();
}

}  // namespace

FrameTopics FrameTopics::below(const std::string& camera, const std::string& input) {
  if (input == "depth") return {camera + "depth/image", camera + "depth/camera_info", "", "", ""};
  return {camera + "disparity", camera + "left/camera_info", camera + "right/camera_info", camera + "left/image_rect",
          camera + "right/image_rect"};
}

FrameAssembler::FrameAssembler(const FrameInputConfig& config, const SyncConfig& sync, const FrameTopics& topics,
                               Callback complete, LeftOut left_out)
    : config_(config),
      topics_(topics),
      complete_(std::move(complete)),
      left_out_(std::move(left_out)),
      pair_matcher_(sync.tolerance()) {}

void FrameAssembler::addDisparity(const stereo_msgs::DisparityImageConstPtr& disparity) {
  FrameMessages frame;
  frame.disparity = disparity;
  add(std::move(frame));
}

void FrameAssembler::addDepth(const sensor_msgs::ImageConstPtr& depth) {
  FrameMessages frame;
  frame.depth = depth;
  add(std::move(frame));
}

void FrameAssembler::add(FrameMessages frame) {
  flush();  // what the one before waited for never came
  waiting_ = std::move(frame);
  flushIfComplete();
}

void FrameAssembler::addInfo(const sensor_msgs::CameraInfoConstPtr& info) {
  infos_.add(info);
  flushIfComplete();
}

void FrameAssembler::addRightInfo(const sensor_msgs::CameraInfoConstPtr& info) {
  right_infos_.add(info);
  flushIfComplete();
}

void FrameAssembler::addImage(Side side, const sensor_msgs::ImageConstPtr& image) {
  (side == Side::kLeft ? left_comes_ : right_comes_) = true;
  if (const auto pair = pair_matcher_.add(side, image)) addBounded(*pair, kDepth, &pairs_);
  flushIfComplete();
}

void FrameAssembler::flushIfComplete() {
  if (waiting_ && !imagesMayStillCome() && !infosMayStillCome()) flush();
}

bool FrameAssembler::imagesMayStillCome() const {
  return waiting_->disparity && left_comes_ && right_comes_ && pairOf(waiting_->header().stamp) == pairs_.rend();
}

bool FrameAssembler::infosMayStillCome() const {
  return !infos_.newest() || (waiting_->disparity && right_info_comes_ && !right_infos_.newest());
}

std::deque<FrameAssembler::ImagePairs::Pair>::const_reverse_iterator FrameAssembler::pairOf(const ros::Time& stamp) const {
  return std::find_if(pairs_.rbegin(), pairs_.rend(),
                      [&stamp](const ImagePairs::Pair& pair) { return pair.left->header.stamp == stamp; });
}

void FrameAssembler::takeImages(FrameMessages* frame) {
  const auto pair = pairOf(frame->header().stamp);
  if (pair == pairs_.rend()) return;
  frame->left = pair->left;
  frame->right = pair->right;
  // The disparities of those that arrived before never came.
  pairs_.erase(pairs_.begin(), pair.base());
}

void FrameAssembler::flush() {
  if (!waiting_) return;
  FrameMessages frame = std::move(*waiting_);
  waiting_.reset();
  const ros::Time stamp = frame.header().stamp;
  frame.info = infoAt(infos_, stamp);
  frame.right_info = infoAt(right_infos_, stamp);
  if (frame.disparity) takeImages(&frame);
  if (!frame.info) {
    if (left_out_) left_out_(topics_.info + ": no CameraInfo yet; until the first one, " + topics_.frame + " is not used");
    return;
  }
  addBounded(frame, kDepth, &frames_);
  if (complete_) complete_(frame);
}

void FrameAssembler::clear() {
  waiting_.reset();
  infos_.clear();
  right_infos_.clear();
  pair_matcher_.clear();
  pairs_.clear();
  frames_.clear();
  left_comes_ = right_comes_ = right_info_comes_ = false;
}

std::optional<FrameMessages> FrameAssembler::find(const ros::Time& stamp) const {
  for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame)
    if (frame->header().stamp == stamp) return *frame;
  return {};
}

FrameViews FrameAssembler::view(const FrameMessages& messages) const {
  FrameViews views;
  if (messages.depth) {
    views.depth = toDepth(messages.depth, topics_.frame);
    views.frame = depthFrame(messages, views.depth->image);
    return views;
  }
  const core::StereoCamera camera =
      toDisparityCamera(*messages.disparity, topics_.frame, *messages.info, topics_.info, messages.right_info.get());
  views.frame.camera = camera;
  views.frame.disparity = toDisparities(*messages.disparity, topics_.frame, camera);
  if (!messages.left) return views;
  views.left = toMono(messages.left, topics_.left);
  views.right = toMono(messages.right, topics_.right);
  requireSize(views.left->image, camera, topics_.left);
  requireSize(views.right->image, camera, topics_.right);
  views.frame.left = views.left->image;
  views.frame.right = views.right->image;
  return views;
}

core::DepthFrame FrameAssembler::depthFrame(const FrameMessages& messages, const cv::Mat& depth) const {
  const core::StereoCamera camera = toDepthCamera(*messages.info, topics_.info, config_.virtual_baseline);
  try {
    return core::frameFromDepth(depth, camera, config_.depth_scale);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(topics_.frame + ": " + error.what());
  }
}

}  // namespace cabinet_articulation
