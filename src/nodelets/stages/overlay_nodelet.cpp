// SPDX-License-Identifier: BSD-3-Clause
#include <pluginlib/class_list_macros.hpp>

#include "cabinet_articulation/joints/hanging.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/image_conversions.h"
#include "nodelets/input/transform_source.h"
#include "nodelets/stages/stage_nodelet.h"
#include "ros/drawing/markers.h"
#include "ros/drawing/model_drawing.h"
#include "ros/drawing/overlay.h"
#include "ros/input/input_settings.h"
#include "ros/input/recent_messages.h"

namespace cabinet_articulation {
namespace {

constexpr size_t kDepth = 32;              // the models come last, several frames after the image
constexpr double kFarthest = 4;            // [m] white in a picture made from depth
constexpr double kTransformTimeout = 0.1;  // [s]

/// Something to draw on: the left image, or a depth image in grey.
cv::Mat3b background(const sensor_msgs::ImageConstPtr& message, const std::string& topic, const FrameInputConfig& input) {
  const bool is_depth = input.input == "depth";
  cv::Mat grey = is_depth ? toDepth(message, topic)->image : toMono(message, topic)->image;
  if (is_depth) grey.convertTo(grey, CV_8U, 255 / kFarthest * (grey.depth() == CV_16U ? input.depth_scale : 1));
  cv::Mat3b bgr;
  cv::cvtColor(grey, bgr, cv::COLOR_GRAY2BGR);
  return bgr;
}

}  // namespace

/// Rectangles and models -> a picture with everything drawn in, and markers for RViz. Drawn once per frame: when the models
/// of the frame arrive, or its rectangles if nobody publishes models.
class OverlayStage : public StageNodelet {
 public:
  OverlayStage() : StageNodelet("overlay") {}

 private:
  struct Input {
    sensor_msgs::ImageConstPtr image;
    sensor_msgs::CameraInfoConstPtr info;
    RectangleArrayConstPtr rectangles;
    ArticulationModelArrayConstPtr models;

    const std_msgs::Header& header() const { return models ? models->header : rectangles->header; }
  };

  void start() override {
    loadSettings(input_, transport_);
    requireInstalled(getNodeHandle(), transport_.image_transport);
    for (const WatchedSubscriber* topic : {&image_topic_, &info_topic_, &rectangles_topic_}) require(topic);
    overlay_ = advertise<sensor_msgs::Image>("overlay");
    markers_ = advertise<visualization_msgs::MarkerArray>("markers");
  }

  bool fromDepth() const { return input_.input == "depth"; }

  void subscribe() override {
    ros::NodeHandle& nh = getNodeHandle();
    const std::string camera = fromDepth() ? "depth/" : "left/";
    info_topic_.subscribe<sensor_msgs::CameraInfo>(nh, camera + "camera_info", guard(),
                                                   [this](const auto& info) { info_ = info; });
    image_topic_.subscribeImage(nh, getPrivateNodeHandle(), camera + (fromDepth() ? "image" : "image_rect"),
                                transport_.image_transport, guard(), [this](const auto& image) { images_.add(image); });
    rectangles_topic_.subscribe<RectangleArray>(nh, "rectangles", guard(), [this](const auto& rectangles) {
      recent_rectangles_.add(rectangles);
      if (models_topic_.publishers() == 0) put({images_.find(rectangles->header.stamp), info_, rectangles, nullptr});
    });
    models_topic_.subscribe<ArticulationModelArray>(nh, "models", guard(), [this](const auto& models) {
      const ros::Time& stamp = models->header.stamp;
      put({images_.find(stamp), info_, recent_rectangles_.find(stamp), models});
    });
  }

  void unsubscribe() override {
    for (WatchedSubscriber* topic : {&image_topic_, &info_topic_, &rectangles_topic_, &models_topic_}) topic->shutdown();
    images_.clear();
    recent_rectangles_.clear();
    info_.reset();
  }

  void put(const Input& input) {
    workOnNewest([this, input] { process(input); });
  }

  void process(const Input& input) {
    runStage(input.header(), [&] {
      std::vector<core::DetectedRectangle> rectangles;
      std::vector<core::LearnedModel> models;
      std::string left_out;
      if (input.rectangles) rectangles = rectangles_topic_.decode(*input.rectangles);
      if (input.models) models = core::allPlaced(usableModels(*input.models, &left_out));
      if (!left_out.empty()) trouble("models", models_topic_.topic() + ": " + left_out + "; it is left out");
      if (markers_.getNumSubscribers() > 0) publishMarkers(input, rectangles, models);
      if (overlay_.getNumSubscribers() > 0 && input.image && input.info) publishOverlay(input, rectangles, models);
    });
  }

  void publishMarkers(const Input& input, const std::vector<core::DetectedRectangle>& rectangles,
                      const std::vector<core::LearnedModel>& models) {
    visualization_msgs::MarkerArray markers;
    if (input.rectangles) addMarkers(rectangles, input.rectangles->header, &markers);
    if (input.models) addMarkers(models, input.models->header, &markers);
    history_.deleteVanished(&markers);
    publish(markers_, std::move(markers));
  }

  void publishOverlay(const Input& input, const std::vector<core::DetectedRectangle>& rectangles,
                      std::vector<core::LearnedModel> models) {
    const std_msgs::Header& header = input.image->header;
    // Only the projection matters here, so the left camera of a pair serves as a depth camera would.
    const core::StereoCamera camera = toDepthCamera(*input.info, info_topic_.topic(), input_.virtual_baseline);
    if (!models.empty()) {
      const Eigen::Isometry3d T_camera_fixed =
          transforms_.lookup(header.frame_id, input.models->header.frame_id, header.stamp, kTransformTimeout);
      for (core::LearnedModel& model : models) model = transformed(model, T_camera_fixed);
    }
    cv::Mat3b image = background(input.image, image_topic_.topic(), input_);
    drawOverlay(camera, rectangles, models, &image);
    publish(overlay_, *cv_bridge::CvImage(header, sensor_msgs::image_encodings::BGR8, image).toImageMsg());
  }

  FrameInputConfig input_;
  ImageTransportConfig transport_;
  TransformSource transforms_{guard()};
  MarkerHistory history_;
  RecentMessages<sensor_msgs::Image> images_{kDepth};
  RecentMessages<RectangleArray> recent_rectangles_{kDepth};
  sensor_msgs::CameraInfoConstPtr info_;
  ros::Publisher overlay_, markers_;
  WatchedSubscriber image_topic_, info_topic_, rectangles_topic_, models_topic_;
};

using OverlayNodelet = EndsInOrder<OverlayStage>;

}  // namespace cabinet_articulation

PLUGINLIB_EXPORT_CLASS(cabinet_articulation::OverlayNodelet, nodelet::Nodelet)
