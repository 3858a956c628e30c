// SPDX-License-Identifier: BSD-3-Clause
#include <cabinet_articulation/ArticulationModelArray.h>
#include <cabinet_articulation/RectangleArray.h>
#include <gtest/gtest.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <visualization_msgs/MarkerArray.h>

#include "cabinet_articulation/joints/hanging.h"
#include "cabinet_articulation/joints/joint.h"
#include "cabinet_articulation/ros/conversions.h"
#include "ros/drawing/model_drawing.h"
#include "support/models.h"
#include "support/ros_messages.h"
#include "support/ros_probe.h"

namespace cabinet_articulation {
namespace {

using test::Recorder;
using test::spinUntil;
using visualization_msgs::Marker;

/// A door, a rectangle on it and the image they are drawn into. The models live in `map`, away from the camera.
class OverlayNodelet : public testing::Test {
 protected:
  OverlayNodelet() {
    geometry_msgs::TransformStamped transform = tf2::eigenToTransform(T_map_camera_);
    transform.header.stamp = ros::Time::now();
    transform.header.frame_id = "map";
    transform.child_frame_id = "camera";
    broadcaster_.sendTransform(transform);
  }

  void SetUp() override {
    ASSERT_TRUE(spinUntil([&] { return overlays_.connected() && markers_.connected() && image_.getNumSubscribers() > 0; }));
  }

  std_msgs::Header header(const std::string& frame) const {
    std_msgs::Header header;
    header.frame_id = frame;
    header.stamp = stamp_;
    return header;
  }

  void publishFrame(const std::vector<core::LearnedModel>& models_in_camera) {
    stamp_ += ros::Duration(0.1);
    std::vector<core::LearnedModel> models;
    for (const core::LearnedModel& model : models_in_camera) models.push_back(transformed(model, T_map_camera_));
    core::DetectedRectangle rectangle;
    rectangle.rectangle = frontAt(test::doorModel(), test::doorModel().q);
    info_.publish(test::cameraInfo(camera_, false, header("camera")));
    image_.publish(test::greyImage(camera_.width, camera_.height, header("camera"), [](int, int) { return 40; }));
    rectangles_.publish(toMessage(std::vector<core::DetectedRectangle>{rectangle}, header("camera")));
    output_.publish(toMessage(models, header("map")));
  }

  /// Publishes until a picture and markers of the same frame have come; the first transform may need a moment.
  bool answered(const std::vector<core::LearnedModel>& models) {
    return spinUntil([&] {
      publishFrame(models);
      return spinUntil(
          [&] {
            return !overlays_.messages.empty() && overlays_.messages.back()->header.stamp == stamp_ && !markers_.messages.empty();
          },
          0.3);
    });
  }

  bool brightAt(const Eigen::Vector3d& p_camera) const {
    const Eigen::Vector2d uv = camera_.project(p_camera);
    const sensor_msgs::Image& image = *overlays_.messages.back();
    for (int v = static_cast<int>(uv.y()) - 1; v <= uv.y() + 1; ++v)
      for (int u = static_cast<int>(uv.x()) - 1; u <= uv.x() + 1; ++u)
        if (image.data[static_cast<size_t>(v) * image.step + 3 * u + 1] > 80) return true;
    return false;
  }

  const core::StereoCamera camera_ = test::smallCamera();
  const Eigen::Isometry3d T_map_camera_ =
      Eigen::Translation3d(3, 1, 1) * Eigen::Isometry3d(Eigen::AngleAxisd(-M_PI / 2, Eigen::Vector3d::UnitX()));
  ros::Time stamp_ = ros::Time::now();
  ros::NodeHandle nh_;
  tf2_ros::StaticTransformBroadcaster broadcaster_;
  ros::Publisher info_ = nh_.advertise<sensor_msgs::CameraInfo>("left/camera_info", 10);
  ros::Publisher image_ = nh_.advertise<sensor_msgs::Image>("left/image_rect", 10);
  ros::Publisher rectangles_ = nh_.advertise<RectangleArray>("rectangles", 10);
  ros::Publisher output_ = nh_.advertise<ArticulationModelArray>("models", 10);
  Recorder<sensor_msgs::Image> overlays_{"overlay"};
  Recorder<visualization_msgs::MarkerArray> markers_{"markers"};
};

TEST_F(OverlayNodelet, DrawsModelsOfTheFixedFrameIntoTheCamerasImage) {
  ASSERT_TRUE(answered({test::doorModel()}));
  const sensor_msgs::Image& image = *overlays_.messages.back();
  EXPECT_EQ(image.encoding, "bgr8");
  EXPECT_EQ(image.width, 320u);
  EXPECT_EQ(image.header.frame_id, "camera");
  const core::LearnedModel door = test::doorModel();
  for (const Eigen::Vector3d& corner : frontAt(door, door.q).corners()) EXPECT_TRUE(brightAt(corner)) << corner.transpose();
  EXPECT_FALSE(brightAt({0.55, 0.3, 1.2})) << "nothing is there";
}

TEST_F(OverlayNodelet, MarkersComeAndGoWithTheModels) {
  ASSERT_TRUE(answered({test::doorModel()}));
  std::map<std::string, Marker> shown;
  for (const Marker& marker : markers_.messages.back()->markers) shown[marker.ns] = marker;
  for (const char* ns : {"rectangles", "fronts", "axes", "ways", "sweep", "labels"}) EXPECT_EQ(shown.count(ns), 1u) << ns;
  EXPECT_EQ(shown["rectangles"].header.frame_id, "camera");
  EXPECT_EQ(shown["fronts"].header.frame_id, "map");
  markers_.messages.clear();
  ASSERT_TRUE(answered({}));
  int deleted = 0;
  for (const auto& message : markers_.messages)
    for (const Marker& marker : message->markers) deleted += marker.action == Marker::DELETE && marker.id == 3;
  EXPECT_EQ(deleted, 5);
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "overlay_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
