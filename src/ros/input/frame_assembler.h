// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <stereo_msgs/DisparityImage.h>

#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "cabinet_articulation/stereo/depth_frame.h"
#include "ros/input/input_settings.h"
#include "ros/input/pair_matcher.h"
#include "ros/input/recent_messages.h"

namespace cabinet_articulation {

/// What the inputs of a frame are called. Where the input has no such topic, its name is empty.
struct FrameTopics {
  std::string frame;  ///< the disparity or depth image
  std::string info, right_info;
  std::string left, right;  ///< rectified images

  /// The names below `camera`, a namespace that ends in '/', or nothing. `input` as in FrameInputConfig.
  static FrameTopics below(const std::string& camera, const std::string& input);
};

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

/// Puts disparity (or depth), camera and images together, in whatever order they arrive, for nodelets and tools alike.
///
/// CameraInfos hardly change: the one of the frame's stamp serves, and else the newest. A frame waits for what is missing, at
/// most until the next one: for the first CameraInfo, without which it is left out, and a disparity for its images and the first
/// right CameraInfo if these come in or are expected.
/// A pair of images belongs to one disparity at most, so that stamps may come again when time is set back.
class FrameAssembler {
 public:
  using Callback = std::function<void(const FrameMessages&)>;
  using LeftOut = std::function<void(const std::string& why)>;

  /// `topics` are named in errors. `complete` (may be empty) is called for every frame, from within the functions below, and
  /// `left_out` (may be empty) with the reason in words for every other one.
  FrameAssembler(const FrameInputConfig& config, const SyncConfig& sync, const FrameTopics& topics, Callback complete,
                 LeftOut left_out = {});

  void addDisparity(const stereo_msgs::DisparityImageConstPtr& disparity);
  void addDepth(const sensor_msgs::ImageConstPtr& depth);
  void addLeft(const sensor_msgs::ImageConstPtr& image) { addImage(Side::kLeft, image); }
  void addRight(const sensor_msgs::ImageConstPtr& image) { addImage(Side::kRight, image); }
  void addInfo(const sensor_msgs::CameraInfoConstPtr& info);
  void addRightInfo(const sensor_msgs::CameraInfoConstPtr& info);

  /// Images will come: disparities wait for them also before the first has come. May be called at any time.
  void expectImages() { left_comes_ = right_comes_ = true; }

  /// The same for the first right CameraInfo.
  void expectRightInfo() { right_info_comes_ = true; }

  /// Nothing more will come for the frame that still waits.
  void flush();

  /// Forgets everything.
  void clear();

  /// The complete frame measured at `stamp`, if it is (still) here.
  std::optional<FrameMessages> find(const ros::Time& stamp) const;

  /// Throws std::invalid_argument naming the topic, what is wrong and what was expected. Touches none of the messages here, so
  /// that another thread may call it.
  FrameViews view(const FrameMessages& messages) const;

  const FrameTopics& topics() const { return topics_; }

 private:
  // A stage may lag behind its input by this many frames before it misses one (ours: 1 s at 15 Hz).
  static constexpr size_t kDepth = 16;

  using ImagePairs = PairMatcher<sensor_msgs::Image>;

  void add(FrameMessages frame);
  void addImage(Side side, const sensor_msgs::ImageConstPtr& image);
  void flushIfComplete();
  bool imagesMayStillCome() const;
  bool infosMayStillCome() const;
  std::deque<ImagePairs::Pair>::const_reverse_iterator pairOf(const ros::Time& stamp) const;
  void takeImages(FrameMessages* frame);
  core::DepthFrame depthFrame(const FrameMessages& messages, const cv::Mat& depth) const;

  const FrameInputConfig config_;
  const FrameTopics topics_;
  const Callback complete_;
  const LeftOut left_out_;
  RecentMessages<sensor_msgs::CameraInfo> infos_{kDepth}, right_infos_{kDepth};
  ImagePairs pair_matcher_;
  std::deque<ImagePairs::Pair> pairs_;  ///< in the order of arrival, without those that a frame took
  bool left_comes_ = false, right_comes_ = false, right_info_comes_ = false;
  std::optional<FrameMessages> waiting_;  ///< the newest frame, while something is missing
  std::deque<FrameMessages> frames_;      ///< complete
};

}  // namespace cabinet_articulation
