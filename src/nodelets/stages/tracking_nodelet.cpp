// SPDX-License-Identifier: BSD-3-Clause
#include <cabinet_articulation/KnownFrontArray.h>

#include <atomic>
#include <pluginlib/class_list_macros.hpp>

#include "cabinet_articulation/pipeline/pipeline.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/tracking/rectangle_tracker.h"
#include "nodelets/input/transform_source.h"
#include "nodelets/stages/stage_nodelet.h"
#include "ros/checks/clock_jump.h"

namespace cabinet_articulation {

/// Rectangles -> tracks in the fixed frame, and where the tracks expect the next rectangles.
class TrackingStage : public StageNodelet {
 public:
  TrackingStage() : StageNodelet("tracking") {}

 private:
  void start() override {
    core::TrackingConfig config;
    loadSettings(config, fixed_frame_);
    tracker_ = std::make_unique<core::RectangleTracker>(config);
    offerTuning<core::TrackingConfig>(config, [this](const auto& tuned) {
      // Its fronts keep their ids, in view or not.
      auto tracker = std::make_unique<core::RectangleTracker>(tuned);
      tracker->remember(tracker_->knownTracks());
      tracker->useIdsFrom(tracker_->nextId());
      tracker_ = std::move(tracker);
    });
    require(&rectangles_topic_);
    // Not lazy: what was known before arrives once, and must not be missed.
    known_fronts_.subscribe<KnownFrontArray>(getNodeHandle(), "known_fronts", guard(), [this](const auto& fronts) {
      std::lock_guard<std::mutex> lock(known_mutex_);
      new_known_ = fronts;
    });
    tracks_ = advertise<TrackArray>("tracks", [this](const auto&) { somebody_joined_ = true; });
  }

  void subscribe() override {
    if (!fixed_frame_.fixed_frame.empty()) transforms_.listen();
    // Offered only while this stage works, so that the detector knows whether to wait for it. A hint for the detector, whose
    // interest alone must not keep both stages working.
    std::lock_guard<std::mutex> lock(expected_mutex_);
    expected_ = getNodeHandle().advertise<ExpectedFrontArray>("expected_fronts", 1);
    rectangles_topic_.subscribe<RectangleArray>(getNodeHandle(), "rectangles", guard(), [this](const auto& rectangles) {
      workOnNewest([this, rectangles] { process(*rectangles); });
    });
  }

  void unsubscribe() override {
    rectangles_topic_.shutdown();
    std::lock_guard<std::mutex> lock(expected_mutex_);
    expected_.shutdown();
  }

  void finish() override { known_fronts_.shutdown(); }

  void process(const RectangleArray& rectangles) {
    std_msgs::Header header = rectangles.header;
    if (!fixed_frame_.fixed_frame.empty()) header.frame_id = fixed_frame_.fixed_frame;
    runStage(header, [&] {
      try {
        track(rectangles, header);
      } catch (const std::exception&) {
        publishExpected(header);
        throw;
      }
      publishExpected(header);
    });
  }

  void track(const RectangleArray& rectangles, const std_msgs::Header& header) {
    if (clock_jump_(header.stamp)) {
      NODELET_WARN("%s: time jumped back; all tracks are forgotten", getName().c_str());
      startAfresh(header);
    }
    if (header.frame_id != frame_id_) {
      if (!frame_id_.empty())
        trouble("frame", "the frame changed from '" + frame_id_ + "' to '" + header.frame_id + "'; all tracks are forgotten");
      frame_id_ = header.frame_id;
      startAfresh(header);
    }
    takeOverKnownFronts(header);
    const Eigen::Isometry3d T_fixed_camera =
        transforms_.lookup(header.frame_id, rectangles.header.frame_id, header.stamp, fixed_frame_.transform_timeout);
    const double stamp = header.stamp.toSec();
    // Before the tracker goes on: what it says of a frame that is refused would never be sent.
    core::DepthView view = rectangles_topic_.decode(rectangles.view);
    const auto& tracks = tracker_->process(stamp, core::transformed(rectangles_topic_.decode(rectangles), T_fixed_camera));
    health().note("tracks", static_cast<double>(tracks.size()));
    if (somebody_joined_.exchange(false)) updates_.startAnew();
    TrackArray message = toMessage(updates_.of(tracks, stamp), header);
    message.generation = generation_;
    view.T_fixed_camera = T_fixed_camera * view.T_fixed_camera;
    message.view = toMessage(view);
    publish(tracks_, std::move(message));
  }

  /// After every frame, also one that could not be used: the detector waits for it.
  void publishExpected(const std_msgs::Header& header) {
    std::lock_guard<std::mutex> lock(expected_mutex_);
    if (expected_) publish(expected_, toMessage(tracker_->expected(), header));
  }

  void takeOverKnownFronts(const std_msgs::Header& header) {
    KnownFrontArrayConstPtr known;
    {
      std::lock_guard<std::mutex> lock(known_mutex_);
      known.swap(new_known_);
    }
    if (!known) return;
    std::string left_out;
    known_ = usableTracks(*known, &left_out);
    if (!left_out.empty()) trouble("known fronts", known_fronts_.topic() + ": " + left_out + "; it is left out");
    const bool anew = known->generation != generation_;
    generation_ = known->generation;
    known_frame_ = known->header.frame_id;
    tracker_->useIdsFrom(known->next_id);
    for (const std::uint32_t id : known->forgotten) tracker_->forget(id);
    if (anew)
      startAfresh(header);
    else
      remember(header);
  }

  /// Knows nothing but what was learned in earlier runs.
  void startAfresh(const std_msgs::Header& header) {
    tracker_->reset();
    updates_.startAnew();
    remember(header);
  }

  void remember(const std_msgs::Header& header) {
    if (known_.empty()) return;
    if (known_frame_ != header.frame_id) {
      trouble("known fronts",
              "known fronts are in the frame '" + known_frame_ + "' and tracks in '" + header.frame_id + "'; they are not used");
      return;
    }
    tracker_->remember(known_);
  }

  FixedFrameConfig fixed_frame_;
  std::unique_ptr<core::RectangleTracker> tracker_;
  core::TrackUpdates updates_;
  std::atomic<bool> somebody_joined_{false};  ///< since the last frame
  TransformSource transforms_{guard()};
  ClockJump clock_jump_;
  std::mutex known_mutex_;
  KnownFrontArrayConstPtr new_known_;  ///< not taken over yet
  std::vector<core::Track> known_;
  std::string known_frame_;
  std::string frame_id_;          ///< of the tracks
  std::uint32_t generation_ = 0;  ///< of the known fronts the tracker started from
  ros::Publisher tracks_;
  std::mutex expected_mutex_;  ///< guards expected_
  ros::Publisher expected_;
  WatchedSubscriber rectangles_topic_, known_fronts_;
};

using TrackingNodelet = EndsInOrder<TrackingStage>;

}  // namespace cabinet_articulation

PLUGINLIB_EXPORT_CLASS(cabinet_articulation::TrackingNodelet, nodelet::Nodelet)
