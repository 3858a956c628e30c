// SPDX-License-Identifier: BSD-3-Clause
#include <pluginlib/class_list_macros.hpp>

#include "cabinet_articulation/ros/image_conversions.h"
#include "nodelets/stages/stage_nodelet.h"
#include "ros/images/rectifier.h"
#include "ros/input/input_settings.h"

namespace cabinet_articulation {

/// Raw images of one camera -> grey, rectified ones. As image_proc, whose nodelets end the manager at a CameraInfo that they
/// cannot use.
class RectifyStage : public StageNodelet {
 public:
  RectifyStage() : StageNodelet("rectify") {}

 private:
  void start() override {
    loadSettings(transport_);
    requireInstalled(getNodeHandle(), transport_.image_transport);
    for (const WatchedSubscriber* input : {&image_, &info_topic_}) require(input);
    rectified_ = advertise<sensor_msgs::Image>("image_rect");
  }

  void subscribe() override {
    ros::NodeHandle& nh = getNodeHandle();
    info_topic_.subscribe<sensor_msgs::CameraInfo>(nh, "camera_info", guard(), [this](const auto& info) {
      info_ = info;
      if (early_) process(early_);
      early_.reset();
    });
    image_.subscribeImage(nh, getPrivateNodeHandle(), "image_raw", transport_.image_transport, guard(),
                          [this](const auto& image) { info_ ? process(image) : wait(image); });
  }

  void unsubscribe() override {
    for (WatchedSubscriber* input : {&image_, &info_topic_}) input->shutdown();
    info_.reset();
    early_.reset();
  }

  void wait(const sensor_msgs::ImageConstPtr& image) {
    if (early_) {
      health().note("images before the first CameraInfo", ++left_out_);
      trouble("no camera", info_topic_.topic() + ": no CameraInfo yet; until the first one, " + image_.topic() + " is not used");
    }
    early_ = image;
  }

  /// In the callback, so that both images of a pair get through after a pause: a worker would keep the newest only.
  void process(const sensor_msgs::ImageConstPtr& image) {
    runStage(image->header, [&] {
      const cv_bridge::CvImageConstPtr grey = toMono(image, image_.topic());
      requireSize(grey->image, *info_, image_.topic());
      const cv::Mat rectified = rectify(grey->image);
      if (rectified.data == image->data.data())
        publish(rectified_, image);
      else
        publish(rectified_, toMessage(cv::Mat1b(rectified), image->header));
    });
  }

  cv::Mat rectify(const cv::Mat& image) {
    try {
      return rectifier_(image, *info_);
    } catch (const std::exception& error) {
      throw std::runtime_error(info_topic_.topic() + ": " + error.what());
    }
  }

  ImageTransportConfig transport_;
  Rectifier rectifier_;
  sensor_msgs::CameraInfoConstPtr info_;
  sensor_msgs::ImageConstPtr early_;  ///< the CameraInfo is not known yet
  int left_out_ = 0;
  ros::Publisher rectified_;
  WatchedSubscriber image_, info_topic_;
};

using RectifyNodelet = EndsInOrder<RectifyStage>;

}  // namespace cabinet_articulation

PLUGINLIB_EXPORT_CLASS(cabinet_articulation::RectifyNodelet, nodelet::Nodelet)
