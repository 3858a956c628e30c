// SPDX-License-Identifier: BSD-3-Clause
#include <cabinet_articulation/ArticulationModelArray.h>
#include <nodelet/nodelet.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/transform_broadcaster.h>

#include <boost/make_shared.hpp>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <pluginlib/class_list_macros.hpp>
#include <thread>

#include "cabinet_articulation/ros/image_conversions.h"
#include "nodelets/running/callback_threads.h"
#include "nodelets/running/settings.h"
#include "ros/checks/callback_guard.h"
#include "ros/messages/simulation_conversions.h"
#include "ros/settings/parameters.h"

namespace cabinet_articulation {

/// An active stereo camera that exists only in the computer. Topics: left|right/image_raw and camera_info, depth/image and
/// depth/camera_info (exact), truth. Like a camera, it does not wait: a frame that comes too late is left out. With the pace of
/// the results it waits for the models of the last frame and is the clock, so that nothing depends on the machine's speed.
class SimulatedStereoCameraNodelet final : public nodelet::Nodelet {
 public:
  ~SimulatedStereoCameraNodelet() override {
    callbacks_.stop();
    results_.shutdown();
    {
      std::lock_guard<std::mutex> lock(mutex_);
      stopped_ = true;
    }
    wake_.notify_all();
    if (thread_.joinable()) thread_.join();
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::uint32_t kQueue = 4;
  static constexpr std::chrono::seconds kPatience{5};  ///< until a frame is given up that no models come of
  static constexpr std::chrono::seconds kQuiet{10};    ///< between two warnings of frames that come late

  void onInit() override {
    guard_("start", [this] { start(); });
  }

  void start() {
    for (const std::string& warning : loadParameters(getPrivateNodeHandle(), config_, settings_))
      NODELET_WARN("%s: %s", getName().c_str(), warning.c_str());
    if (paced() && ros::Time::useSystemTime())
      throw std::invalid_argument("pace 'results' needs simulated time, set /use_sim_time before the start");
    camera_ = std::make_unique<core::SimulatedStereoCamera>(config_);
    ros::NodeHandle& nh = getNodeHandle();
    nh.setCallbackQueue(callbacks_.queue());
    left_ = nh.advertise<sensor_msgs::Image>("left/image_raw", kQueue);
    right_ = nh.advertise<sensor_msgs::Image>("right/image_raw", kQueue);
    depth_ = nh.advertise<sensor_msgs::Image>("depth/image", kQueue);
    left_info_ = nh.advertise<sensor_msgs::CameraInfo>("left/camera_info", kQueue);
    right_info_ = nh.advertise<sensor_msgs::CameraInfo>("right/camera_info", kQueue);
    depth_info_ = nh.advertise<sensor_msgs::CameraInfo>("depth/camera_info", kQueue);
    truth_ = nh.advertise<SceneTruth>("truth", kQueue);
    if (paced()) {
      clock_ = nh.advertise<rosgraph_msgs::Clock>("/clock", kQueue);
      results_ = nh.subscribe<ArticulationModelArray>("models", kQueue, [this](const auto& models) {
        guard_("models", [&] {
          std::lock_guard<std::mutex> lock(mutex_);
          newest_result_ = models->header.stamp;
          wake_.notify_all();
        });
      });
    }
    if (!settings_.world_frame.empty()) broadcaster_ = std::make_unique<tf2_ros::TransformBroadcaster>();
    callbacks_.start(1);
    thread_ = std::thread([this] { guard_("camera", [this] { run(); }); });
  }

  bool paced() const { return settings_.pace == "results"; }

  void run() {
    const std::chrono::duration<double> period(1 / config_.rate);
    while (!pauseUntil(Clock::now() + std::chrono::duration_cast<Clock::duration>(period)) && !mayStart()) {
    }
    paced() ? runAtPaceOfResults() : runInTime(period);
  }

  /// The next frame is rendered while the pipeline works on the last one.
  void runAtPaceOfResults() {
    ros::Time last;
    for (int frame = 0;; ++frame) {
      const core::StereoFrame rendered = camera_->frame(frame);
      if (!awaitResult(last)) return;
      // Time 0 means "the newest" to tf.
      last = ros::Time((frame + 1) / config_.rate);
      rosgraph_msgs::Clock clock;
      clock.clock = last;
      clock_.publish(clock);
      publishState(frame, headerAt(last));
      publishImages(rendered, headerAt(last));
    }
  }

  /// False as soon as the nodelet ends.
  bool awaitResult(const ros::Time& stamp) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!wake_.wait_for(lock, kPatience, [&] { return stopped_ || newest_result_ >= stamp; }))
      NODELET_WARN("%s: no models for the frame at %.3f s within %d s, it is given up", getName().c_str(), stamp.toSec(),
                   static_cast<int>(kPatience.count()));
    return !stopped_;
  }

  void runInTime(const std::chrono::duration<double>& period) {
    const Clock::time_point start = Clock::now();
    const ros::Time first_stamp = ros::Time::now();
    int frame = 0;
    while (!pauseUntil(start + std::chrono::duration_cast<Clock::duration>(frame * period))) {
      const std_msgs::Header header = headerAt(first_stamp + ros::Duration(frame / config_.rate));
      publishState(frame, header);
      if (isWatched()) publishImages(camera_->frame(frame), header);
      const int due = static_cast<int>((Clock::now() - start) / period);
      if (due > frame + 1) warnOfLateFrames();
      frame = std::max(frame + 1, due);
    }
  }

  /// Now and then. ROS's throttled logging shares one time between all cameras of a manager, without a lock.
  void warnOfLateFrames() {
    if (Clock::now() < next_warning_) return;
    next_warning_ = Clock::now() + kQuiet;
    NODELET_WARN("%s: a frame takes longer than 1 / rate = %.0f ms, some are left out", getName().c_str(), 1e3 / config_.rate);
  }

  bool mayStart() const {
    const bool watched = (left_.getNumSubscribers() > 0 && right_.getNumSubscribers() > 0) || depth_.getNumSubscribers() > 0;
    return watched || !settings_.wait_for_subscribers;
  }

  bool isWatched() const { return left_.getNumSubscribers() + right_.getNumSubscribers() + depth_.getNumSubscribers() > 0; }

  /// True as soon as the nodelet ends.
  bool pauseUntil(Clock::time_point time) {
    std::unique_lock<std::mutex> lock(mutex_);
    return wake_.wait_until(lock, time, [this] { return stopped_; });
  }

  std_msgs::Header headerAt(const ros::Time& stamp) const {
    std_msgs::Header header;
    header.stamp = stamp;
    header.frame_id = settings_.frame_id;
    return header;
  }

  void publishState(int frame, const std_msgs::Header& header) {
    const core::StereoCamera& camera = camera_->camera();
    const core::GroundTruth truth = camera_->truth(frame);
    truth_.publish(toMessage(truth, header, settings_.world_frame));
    if (broadcaster_) {
      geometry_msgs::TransformStamped transform = tf2::eigenToTransform(truth.T_world_camera);
      transform.header.stamp = header.stamp;
      transform.header.frame_id = settings_.world_frame;
      transform.child_frame_id = settings_.frame_id;
      broadcaster_->sendTransform(transform);
    }
    left_info_.publish(toLeftCameraInfo(camera, header));
    right_info_.publish(toRightCameraInfo(camera, header));
    depth_info_.publish(toLeftCameraInfo(camera, header));
  }

  void publishImages(const core::StereoFrame& rendered, const std_msgs::Header& header) {
    left_.publish(boost::make_shared<sensor_msgs::Image>(toMessage(rendered.left, header)));
    right_.publish(boost::make_shared<sensor_msgs::Image>(toMessage(rendered.right, header)));
    depth_.publish(cv_bridge::CvImage(header, "32FC1", rendered.depth).toImageMsg());
  }

  const CallbackGuard guard_{
      [this](const std::string&, const std::string& what) { NODELET_FATAL("%s: %s", getName().c_str(), what.c_str()); }};
  CallbackThreads callbacks_;  ///< outlives all that has callbacks, publishers too
  core::SimulationConfig config_;
  SimulatedCameraSettings settings_;
  std::unique_ptr<core::SimulatedStereoCamera> camera_;
  ros::Publisher left_, right_, depth_, left_info_, right_info_, depth_info_, truth_, clock_;
  ros::Subscriber results_;
  std::unique_ptr<tf2_ros::TransformBroadcaster> broadcaster_;

  std::thread thread_;
  Clock::time_point next_warning_;  ///< used by thread_ alone
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stopped_ = false;     ///< guarded by mutex_, like the next
  ros::Time newest_result_;  ///< stamp of the newest models
};

}  // namespace cabinet_articulation

PLUGINLIB_EXPORT_CLASS(cabinet_articulation::SimulatedStereoCameraNodelet, nodelet::Nodelet)
