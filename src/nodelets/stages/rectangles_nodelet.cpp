// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <cmath>
#include <pluginlib/class_list_macros.hpp>
#include <sstream>

#include "bend/bend_correction.h"
#include "cabinet_articulation/pipeline/pipeline.h"
#include "cabinet_articulation/rectangles/rectangle_detector.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/image_conversions.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "nodelets/input/expected_inbox.h"
#include "nodelets/input/frame_input.h"
#include "nodelets/input/transform_source.h"
#include "nodelets/stages/stage_nodelet.h"
#include "ros/checks/clock_jump.h"
#include "ros/messages/plane_messages.h"

namespace cabinet_articulation {

/// Plane regions and the frame they come from -> rectangles. Tracks tell where to expect some of them: those after the last frame
/// that was worked on. A frame waits for these no longer than until the next one is due.
class RectanglesStage : public StageNodelet {
 public:
  RectanglesStage() : StageNodelet("rectangles") {}

 private:
  struct Input {
    FrameMessages frame;
    PlaneArrayConstPtr planes;
    double period;  ///< [s] since the frame before came
    int subscription;
  };

  void start() override {
    core::RectanglesConfig config;
    FrameInputConfig input;
    SyncConfig sync;
    ImageTransportConfig transport;
    loadSettings(config, input, sync, transport);
    core::PlanesConfig planes;  // of the stage beside this one, which itself warns of settings that it does not know
    loadParameters(ros::NodeHandle(getNodeHandle(), "planes"), planes);
    const auto apply = [this, planes](const core::RectanglesConfig& tuned) {
      detector_ = std::make_unique<core::RectangleDetector>(tuned, planes);
      use_tracks_ = tuned.use_tracks;
    };
    apply(config);
    offerTuning<core::RectanglesConfig>(config, apply);
    frames_ = std::make_unique<FrameInput>(getNodeHandle(), getPrivateNodeHandle(), input, sync, transport, guard());
    require(&planes_topic_);
    for (const WatchedSubscriber* topic : frames_->required()) require(topic);
    rectangles_ = advertise<RectangleArray>("rectangles");
  }

  void subscribe() override {
    ros::NodeHandle& nh = getNodeHandle();
    frames_->subscribe([this](const FrameMessages& frame) {
      if (early_planes_ && early_planes_->header.stamp == frame.header().stamp) add(early_planes_);
    });
    planes_topic_.subscribe<PlaneArray>(nh, "planes", guard(), [this](const auto& planes) {
      const ros::Time& stamp = planes->header.stamp;
      period_ = arrived_.isZero() ? 0 : std::min(std::abs(secondsBetween(arrived_, stamp)), kLongestWait);
      arrived_ = stamp;
      add(planes);
    });
    expected_topic_.subscribe<ExpectedFrontArray>(nh, "expected_fronts", guard(),
                                                  [this](const auto& expected) { expected_.put(expected); });
  }

  void unsubscribe() override {
    planes_topic_.shutdown();
    expected_topic_.shutdown();
    if (frames_) frames_->unsubscribe();
    expected_.clear();
    early_planes_.reset();
    arrived_ = ros::Time();
    ++subscription_;
  }

  void interrupt() override { expected_.interrupt(); }

  void add(PlaneArrayConstPtr planes) {
    const std::optional<FrameMessages> frame = frames_->find(planes->header.stamp);
    if (early_planes_ && early_planes_ != planes) health().dropped();
    early_planes_ = frame ? nullptr : planes;
    if (frame) workOnNewest([this, input = Input{*frame, planes, period_, subscription_}] { process(input); });
  }

  void process(const Input& input) {
    const std_msgs::Header& header = input.planes->header;
    const FrameOrder order = clock_jump_.orderOf(header.stamp);
    if (order == FrameOrder::kNotNewer) {
      std::ostringstream text;
      text << planes_topic_.topic() << ": the stamp " << header.stamp << " is not newer than that of the frame before, "
           << *clock_jump_.newest() << "; the frame is skipped";
      return trouble("order", text.str());
    }
    // Nobody answers for a frame of an earlier subscription, or of a time that is not over yet.
    if (order == FrameOrder::kSetBack || input.subscription != worked_on_subscription_) worked_on_ = ros::Time();
    worked_on_subscription_ = input.subscription;
    StageWait wait;
    const std::vector<core::Rectangle> expected = expectedIn(header, input.period, &wait);
    const auto work = [&] {
      const FrameViews views = frames_->view(input.frame);
      const core::DepthFrame frame = correction_.process(views.frame, bendOf(*input.planes));
      const auto rectangles = detector_->process(frame, planes_topic_.decode(*input.planes), expected);
      health().note("rectangles", static_cast<double>(rectangles.size()));
      RectangleArray message = toMessage(rectangles, header);
      message.view = toMessage(core::thinnedOut(frame));
      publish(rectangles_, std::move(message));
      worked_on_ = header.stamp;
    };
    runStage(header, work, wait);
  }

  /// The expected fronts as the camera sees them at the time of this frame; none while the tracker or tf does not know. Waits
  /// for them `period` [s] at most.
  std::vector<core::Rectangle> expectedIn(const std_msgs::Header& camera, double period, StageWait* wait) {
    // A tracker that does not work offers nothing.
    const bool somebody_tracks = use_tracks_ && expected_topic_.publishers() > 0;
    if (!somebody_tracks) expected_.clear();
    if (!somebody_tracks || worked_on_.isZero()) return {};
    const ExpectedInbox::Answer answer = expected_.after(worked_on_, period);
    *wait = {answer.waited, !answer.in_time};
    health().note("waited for tracks [ms]", 1e3 * answer.waited);
    if (!answer.in_time) {
      std::ostringstream text;
      text << "the tracks after the frame before did not come within a frame's time, " << std::lround(1e3 * period)
           << " ms; older ones are used, and results may differ from those of process_bag";
      trouble("tracks", text.str());
    }
    if (!answer.fronts) return {};
    const std::string& fixed_frame = answer.fronts->header.frame_id;
    if (answer.fronts->fronts.empty()) {
      // By the time that there are some, tf must have been listened to.
      if (fixed_frame != camera.frame_id) transforms_.listen();
      return {};
    }
    try {
      const double left = std::max(0.0, period - answer.waited);
      const Eigen::Isometry3d T_fixed_camera = transforms_.lookup(fixed_frame, camera.frame_id, camera.stamp, left);
      return core::expectedInCamera(expected_topic_.decode(*answer.fronts), camera.stamp.toSec(), T_fixed_camera);
    } catch (const std::exception& error) {
      wait->in_vain = true;
      trouble("expected fronts", error.what());
      return {};
    }
  }

  static constexpr double kLongestWait = 1;  ///< [s] for cameras that are slower (ours)

  std::unique_ptr<core::RectangleDetector> detector_;
  core::BendCorrection correction_;
  std::atomic<bool> use_tracks_{true};  ///< of the settings, which may change while a frame waits
  TransformSource transforms_{guard()};
  ExpectedInbox expected_;
  // Of the callbacks.
  PlaneArrayConstPtr early_planes_;  ///< their frame is not complete yet
  ros::Time arrived_;                ///< stamp of the newest planes
  double period_ = 0;                ///< [s] between these and the ones before, worked on or not
  int subscription_ = 0;             ///< counts how often somebody began to listen
  // Of the worker.
  ClockJump clock_jump_;
  ros::Time worked_on_;  ///< stamp of the last frame whose rectangles were published; zero: none in this subscription
  int worked_on_subscription_ = 0;
  ros::Publisher rectangles_;
  std::unique_ptr<FrameInput> frames_;
  WatchedSubscriber planes_topic_, expected_topic_;
};

using RectanglesNodelet = EndsInOrder<RectanglesStage>;

}  // namespace cabinet_articulation

PLUGINLIB_EXPORT_CLASS(cabinet_articulation::RectanglesNodelet, nodelet::Nodelet)
