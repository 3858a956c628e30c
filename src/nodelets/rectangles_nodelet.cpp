// SPDX-License-Identifier: BSD-3-Clause
#include <pluginlib/class_list_macros.hpp>

#include "cabinet_articulation/rectangles/rectangle_detector.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/image_conversions.h"
#include "frame_input.h"
#include "stage_nodelet.h"
#include "transform_source.h"

namespace cabinet_articulation {

/// Plane regions and the frame they come from -> rectangles. Tracks tell where to expect some of them; detection never
/// waits for that.
class RectanglesStage : public StageNodelet {
 public:
  RectanglesStage() : StageNodelet("rectangles") {}

 private:
  struct Input {
    FrameMessages frame;
    PlaneArrayConstPtr planes;
    RectangleArrayConstPtr expected;
  };

  void start() override {
    core::RectanglesConfig config;
    FrameInputConfig input;
    SyncConfig sync;
    loadSettings(config, input, sync);
    detector_ = std::make_unique<core::RectangleDetector>(config);
    offerTuning<core::RectanglesConfig>(
        config, [this](const auto& tuned) { detector_ = std::make_unique<core::RectangleDetector>(tuned); });
    frames_ = std::make_unique<FrameInput>(input, sync);
    require(&planes_topic_);
    for (const WatchedSubscriber* topic : frames_->required()) require(topic);
    rectangles_ = advertise<RectangleArray>("rectangles");
  }

  void subscribe() override {
    ros::NodeHandle& nh = getNodeHandle();
    frames_->subscribe(nh, {});
    planes_topic_.subscribe<PlaneArray>(nh, "planes", [this](const auto& planes) { add(planes); });
    expected_topic_.subscribe<RectangleArray>(nh, "expected_rectangles", [this](const auto& expected) { expected_ = expected; });
  }

  void unsubscribe() override {
    planes_topic_.shutdown();
    expected_topic_.shutdown();
    if (frames_) frames_->unsubscribe();
    expected_.reset();
  }

  void add(const PlaneArrayConstPtr& planes) {
    const std::optional<FrameMessages> frame = frames_->find(planes->header.stamp);
    if (!frame)
      health().dropped();
    else
      workOnNewest([this, input = Input{*frame, planes, expected_}] { process(input); });
  }

  void process(const Input& input) {
    const std_msgs::Header& header = input.planes->header;
    runStage(header, [&] {
      const FrameViews views = frames_->view(input.frame);
      const auto rectangles = detector_->process(views.frame, fromMessage(*input.planes), expectedIn(header, input.expected));
      health().note("rectangles", static_cast<double>(rectangles.size()));
      publish(rectangles_, toMessage(rectangles, header));
    });
  }

  /// The expected rectangles as the camera would see them now; none while tf does not know.
  std::vector<core::Rectangle> expectedIn(const std_msgs::Header& camera, const RectangleArrayConstPtr& message) {
    if (!message || message->rectangles.empty()) return {};
    std::vector<core::Rectangle> expected;
    try {
      const Eigen::Isometry3d T_camera_fixed = transforms_.lookup(camera.frame_id, message->header.frame_id, camera.stamp, 0);
      for (const core::DetectedRectangle& detected : fromMessage(*message)) {
        expected.push_back(detected.rectangle);
        expected.back().pose = T_camera_fixed * detected.rectangle.pose;
      }
    } catch (const std::runtime_error& error) {
      trouble("expected rectangles", error.what());
    }
    return expected;
  }

  std::unique_ptr<core::RectangleDetector> detector_;
  TransformSource transforms_;
  RectangleArrayConstPtr expected_;
  ros::Publisher rectangles_;
  std::unique_ptr<FrameInput> frames_;
  WatchedSubscriber planes_topic_, expected_topic_;
};

using RectanglesNodelet = EndsInOrder<RectanglesStage>;

}  // namespace cabinet_articulation

PLUGINLIB_EXPORT_CLASS(cabinet_articulation::RectanglesNodelet, nodelet::Nodelet)
