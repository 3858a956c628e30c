// SPDX-License-Identifier: BSD-3-Clause
#include <atomic>
#include <cmath>
#include <pluginlib/class_list_macros.hpp>

#include "cabinet_articulation/ros/image_conversions.h"
#include "cabinet_articulation/stereo/block_matcher.h"
#include "nodelets/stages/stage_nodelet.h"
#include "ros/input/input_settings.h"
#include "ros/input/pair_matcher.h"
#include "stereo/pair_watch.h"

namespace cabinet_articulation {

/// Rectified pair -> disparity.
class StereoStage : public StageNodelet {
 public:
  StereoStage() : StageNodelet("stereo") {}

 private:
  using Pair = PairMatcher<sensor_msgs::Image>::Pair;

  struct Input {
    Pair pair;
    sensor_msgs::CameraInfoConstPtr left_info, right_info;
  };

  void start() override {
    core::StereoConfig config;
    SyncConfig sync;
    loadSettings(config, sync, transport_);
    requireInstalled(getNodeHandle(), transport_.image_transport);
    build(config);
    offerTuning<core::StereoConfig>(config, [this](const auto& tuned) { build(tuned); });
    pairs_ = std::make_unique<PairMatcher<sensor_msgs::Image>>(sync.tolerance());
    for (const WatchedSubscriber* input : {&left_, &right_, &left_info_topic_, &right_info_topic_}) require(input);
    disparity_ = advertise<stereo_msgs::DisparityImage>("disparity");
  }

  void build(const core::StereoConfig& config) {
    matcher_ = std::make_unique<core::BlockMatcher>(config);
    leave_out_unlit_ = config.leave_out_unlit;
  }

  void subscribe() override {
    ros::NodeHandle& nh = getNodeHandle();
    left_info_topic_.subscribe<sensor_msgs::CameraInfo>(nh, "left/camera_info", guard(),
                                                        [this](const auto& info) { addInfo(info, &left_info_); });
    right_info_topic_.subscribe<sensor_msgs::CameraInfo>(nh, "right/camera_info", guard(),
                                                         [this](const auto& info) { addInfo(info, &right_info_); });
    left_.subscribeImage(nh, getPrivateNodeHandle(), "left/image_rect", transport_.image_transport, guard(),
                         [this](const auto& image) { add(Side::kLeft, image); });
    right_.subscribeImage(nh, getPrivateNodeHandle(), "right/image_rect", transport_.image_transport, guard(),
                          [this](const auto& image) { add(Side::kRight, image); });
  }

  void unsubscribe() override {
    for (WatchedSubscriber* input : {&left_, &right_, &left_info_topic_, &right_info_topic_}) input->shutdown();
    if (pairs_) pairs_->clear();
    left_info_.reset();
    right_info_.reset();
    early_pair_.reset();
  }

  void add(Side side, const sensor_msgs::ImageConstPtr& image) {
    if (const std::optional<Pair> pair = pairs_->add(side, image)) {
      if (early_pair_) leftOut();
      early_pair_ = pair;
      workIfComplete();
    } else if (const std::optional<double> difference = pairs_->mismatch()) {
      trouble("stamps",
              left_.topic() + " and " + right_.topic() + ": left and right stamps differ by " +
                  std::to_string(std::lround(1e3 * *difference)) +
                  " ms, expected pairs; if the cameras have no common trigger, set approximate_sync and sync_tolerance");
    }
  }

  void addInfo(const sensor_msgs::CameraInfoConstPtr& info, sensor_msgs::CameraInfoConstPtr* newest) {
    *newest = info;
    workIfComplete();
  }

  void workIfComplete() {
    if (!early_pair_ || !left_info_ || !right_info_) return;
    const Input input{*early_pair_, left_info_, right_info_};
    early_pair_.reset();
    // Of every pair: of those that the worker takes, only lit or only unlit ones may be left.
    if (leave_out_unlit_ && projector_.lacksPattern(toMono(input.pair.left, left_.topic())->image)) return leftOutUnlit();
    workOnNewest([this, input] { process(input); });
  }

  void leftOut() {
    health().note("pairs before the first CameraInfo", ++left_out_);
    const WatchedSubscriber& missing = left_info_ ? right_info_topic_ : left_info_topic_;
    trouble("no camera", missing.topic() + ": no CameraInfo yet; until the first one, " + left_.topic() + " and " +
                             right_.topic() + " are not used");
  }

  void leftOutUnlit() {
    health().note("frames without the projector's pattern", ++unlit_);
    trouble("projector", left_.topic() + ": the projector's pattern comes and goes from frame to frame; frames without it are " +
                             "left out (keep the emitter on, or set leave_out_unlit to false)");
  }

  void process(const Input& input) {
    const std_msgs::Header& header = input.pair.left->header;
    runStage(header, [&] {
      const core::StereoCamera camera =
          toStereoCamera(*input.left_info, *input.right_info, left_info_topic_.topic(), right_info_topic_.topic());
      const cv_bridge::CvImageConstPtr left = toMono(input.pair.left, left_.topic());
      const cv_bridge::CvImageConstPtr right = toMono(input.pair.right, right_.topic());
      requireSize(left->image, camera, left_.topic());
      requireSize(right->image, camera, right_.topic());
      const core::StereoConfig& config = matcher_->config();
      const core::DepthFrame frame = matcher_->process(left->image, right->image, camera);
      if (swap_.looksSwapped(frame, matcher_.get()))
        trouble("swapped", left_.topic() + " and " + right_.topic() + " match only the other way round: are they swapped?");
      publish(disparity_, toMessage(frame, header, config.min_disparity, config.disparity_range));
    });
  }

  ImageTransportConfig transport_;
  std::unique_ptr<core::BlockMatcher> matcher_;
  std::unique_ptr<PairMatcher<sensor_msgs::Image>> pairs_;
  sensor_msgs::CameraInfoConstPtr left_info_, right_info_;
  std::optional<Pair> early_pair_;  ///< the CameraInfos are not known yet
  core::ProjectorWatch projector_;
  std::atomic<bool> leave_out_unlit_{true};
  core::SwapWatch swap_;
  int left_out_ = 0, unlit_ = 0;
  ros::Publisher disparity_;
  WatchedSubscriber left_, right_, left_info_topic_, right_info_topic_;
};

using StereoNodelet = EndsInOrder<StereoStage>;

}  // namespace cabinet_articulation

PLUGINLIB_EXPORT_CLASS(cabinet_articulation::StereoNodelet, nodelet::Nodelet)
