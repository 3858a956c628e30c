// SPDX-License-Identifier: BSD-3-Clause
#include <cabinet_articulation/PlaneArray.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/front_scene.h"
#include "support/ros_probe.h"

namespace cabinet_articulation {
namespace {

using test::Recorder;
using test::spinUntil;

/// Publishes what a camera in front of the scene would measure.
class PlanesNodelet : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(spinUntil([&] {
      return planes_.connected() && depth_planes_.connected() && disparity_.getNumSubscribers() > 0 &&
             depth_.getNumSubscribers() > 0 && info_.getNumSubscribers() > 0 && depth_info_.getNumSubscribers() > 0;
    }));
  }

  std_msgs::Header header() {
    std_msgs::Header header;
    header.frame_id = "optical";
    header.stamp = stamp_ += ros::Duration(0.1);
    return header;
  }

  void publish(const stereo_msgs::DisparityImage& disparity) {
    info_.publish(test::cameraInfo(scene_.camera, false, disparity.header));
    disparity_.publish(disparity);
  }

  /// Repeats `publish` until planes come, for the nodelet may not know its camera yet. Not those of earlier frames.
  PlaneArray answer(const std::function<void()>& publish, const Recorder<PlaneArray>& planes) {
    const ros::Time before = stamp_;
    const bool came = spinUntil([&] {
      publish();
      return spinUntil([&] { return !planes.messages.empty() && planes.messages.back()->header.stamp > before; }, 0.3);
    });
    return came ? *planes.messages.back() : PlaneArray();
  }

  bool diagnosed(const std::function<void()>& publish, const std::string& text) {
    return spinUntil([&] {
      publish();
      return spinUntil([&] { return reports_.statusHas("/planes", text) || reports_.statusHas("planes: planes", text); }, 0.1);
    });
  }

  const test::FrontScene scene_;
  ros::Time stamp_ = ros::Time::now();
  ros::NodeHandle nh_;
  ros::Publisher info_ = nh_.advertise<sensor_msgs::CameraInfo>("left/camera_info", 10);
  ros::Publisher disparity_ = nh_.advertise<stereo_msgs::DisparityImage>("disparity", 10);
  ros::Publisher depth_info_ = nh_.advertise<sensor_msgs::CameraInfo>("depth/camera_info", 10);
  ros::Publisher depth_ = nh_.advertise<sensor_msgs::Image>("depth/image", 10);
  Recorder<PlaneArray> planes_{"planes"}, depth_planes_{"depth/planes"};
  test::Reports reports_;
};

/// The front must be there: distance within 2 mm, direction within 0.3 degrees (the input has no noise), size within 10 % (the
/// region may leave out its outermost two pixels).
void expectFront(const PlaneArray& planes, const test::FrontScene& scene) {
  const double z = scene.front.center().z();
  const double pixels = scene.front.width * scene.front.height * scene.camera.fx * scene.camera.fy / (z * z);
  const auto is_front = [&](const Plane& plane) {
    return std::abs(plane.coefficients[3] - z) < 0.002 && plane.coefficients[2] < -0.99998 &&
           std::abs(plane.inliers - pixels) < 0.1 * pixels;
  };
  const auto front = std::find_if(planes.planes.begin(), planes.planes.end(), is_front);
  ASSERT_NE(front, planes.planes.end()) << planes.planes.size() << " planes";
  const Eigen::Vector2d centre = scene.camera.project(scene.front.center());
  const auto label = [&](double u, double v) {
    return front->mask.data[static_cast<size_t>(v) * front->mask.step + static_cast<size_t>(u)];
  };
  EXPECT_EQ(label(centre.x(), centre.y()), Plane::IN_PLANE);
  EXPECT_EQ(label(20, 20), Plane::FREE) << "the wall is behind the front's plane";
}

TEST_F(PlanesNodelet, FindsTheFrontInADisparityImage) {
  std_msgs::Header sent;
  const PlaneArray planes = answer([&] { publish(scene_.disparityMessage(sent = header())); }, planes_);
  expectFront(planes, scene_);
  EXPECT_EQ(planes.header.stamp, sent.stamp);
  EXPECT_EQ(planes.header.frame_id, "optical");
}

TEST_F(PlanesNodelet, ToleratesNanAndInf) {
  const auto spoiled = [&](int u, int v) {
    const int k = (7 * u + 3 * v) % 100;
    return k == 0   ? std::numeric_limits<float>::quiet_NaN()
           : k == 1 ? std::numeric_limits<float>::infinity()
           : k == 2 ? -1
                    : scene_.disparity(u, v);
  };
  const PlaneArray planes = answer([&] { publish(test::disparityImage(scene_.camera, header(), spoiled)); }, planes_);
  EXPECT_TRUE(std::any_of(planes.planes.begin(), planes.planes.end(),
                          [](const Plane& plane) { return std::abs(plane.coefficients[3] - 1.2) < 0.002; }));
}

TEST_F(PlanesNodelet, FindsTheFrontInADepthImageOfMetres) {
  const auto publish = [&] {
    sensor_msgs::Image depth =
        test::disparityImage(scene_.camera, header(), [&](int u, int v) { return static_cast<float>(scene_.depth(u, v)); }).image;
    depth_info_.publish(test::cameraInfo(scene_.camera, false, depth.header));
    depth_.publish(depth);
  };
  expectFront(answer(publish, depth_planes_), scene_);
}

TEST_F(PlanesNodelet, FindsTheFrontInADepthImageOfMillimetres) {
  const auto publish = [&] {
    sensor_msgs::Image depth;
    depth.header = header();
    depth.encoding = "16UC1";
    depth.width = scene_.camera.width;
    depth.height = scene_.camera.height;
    depth.step = 2 * depth.width;
    for (int v = 0; v < scene_.camera.height; ++v)
      for (int u = 0; u < scene_.camera.width; ++u) {
        const int millimetres = static_cast<int>(1000 * scene_.depth(u, v) + 0.5);
        depth.data.push_back(millimetres & 0xFF);
        depth.data.push_back(millimetres >> 8);
      }
    depth_info_.publish(test::cameraInfo(scene_.camera, false, depth.header));
    depth_.publish(depth);
  };
  expectFront(answer(publish, depth_planes_), scene_);
}

/// bends.yaml says by how much this camera bends; the message says what was taken.
TEST_F(PlanesNodelet, TakesABendThatAnEarlierRunLearned) {
  core::StereoCamera camera = scene_.camera;
  camera.baseline = 0.075;  // virtual_baseline
  const auto bent = [&](int u, int v) {
    const double x = (2 * u + 1.0) / camera.width - 1;
    return static_cast<float>(camera.depth(camera.disparity(scene_.depth(u, v)) + 0.5 * (3 * x * x - 1) / 2));
  };
  Recorder<PlaneArray> planes("bent/planes");
  ros::Publisher info = nh_.advertise<sensor_msgs::CameraInfo>("bent/camera_info", 10);
  ros::Publisher image = nh_.advertise<sensor_msgs::Image>("bent/image", 10);
  const auto publish = [&] {
    const sensor_msgs::Image depth = test::disparityImage(camera, header(), bent).image;
    info.publish(test::cameraInfo(camera, false, depth.header));
    image.publish(depth);
  };
  const PlaneArray found = answer(publish, planes);
  expectFront(found, scene_);
  ASSERT_EQ(found.bend.size(), 12U);
  EXPECT_EQ(found.bend[0], 0.5);
  EXPECT_TRUE(std::all_of(found.bend.begin() + 1, found.bend.end(), [](double term) { return term == 0; }));
}

TEST_F(PlanesNodelet, SaysThatADisparityIsAllInvalid) {
  const auto publish_nothing = [&] { publish(test::disparityImage(scene_.camera, header(), [](int, int) { return 0.F; })); };
  EXPECT_TRUE(answer(publish_nothing, planes_).planes.empty());
  EXPECT_TRUE(diagnosed(publish_nothing, "/disparity: no pixel has a valid depth")) << reports_.status("planes");
  EXPECT_TRUE(reports_.logged(rosgraph_msgs::Log::WARN, "/disparity: no pixel has a valid depth"));
  expectFront(answer([&] { publish(scene_.disparityMessage(header())); }, planes_), scene_);
}

TEST_F(PlanesNodelet, NamesABadDisparityImage) {
  stereo_msgs::DisparityImage message = scene_.disparityMessage(header());
  message.T = 0;
  EXPECT_TRUE(diagnosed([&] { publish(message); }, "/disparity: baseline T is 0, expected 0.001")) << reports_.status("planes");
  message = scene_.disparityMessage(header());
  message.image.width = message.image.height = message.image.step = 0;
  message.image.data.clear();
  EXPECT_TRUE(diagnosed([&] { publish(message); }, "/disparity: size is 0x0, expected 320x240")) << reports_.status("planes");
  expectFront(answer([&] { publish(scene_.disparityMessage(header())); }, planes_), scene_);
}

TEST_F(PlanesNodelet, SaysThatItsCameraIsUnknown) {
  ros::Publisher info = nh_.advertise<sensor_msgs::CameraInfo>("new_camera/left/camera_info", 10);
  ros::Publisher disparity = nh_.advertise<stereo_msgs::DisparityImage>("new_camera/disparity", 10);
  const Recorder<PlaneArray> planes("new_camera/planes");
  ASSERT_TRUE(spinUntil([&] { return info.getNumSubscribers() > 0 && disparity.getNumSubscribers() > 0; }));
  const std::string trouble =
      "/new_camera/left/camera_info: no CameraInfo yet; until the first one, /new_camera/disparity is not used";
  EXPECT_TRUE(spinUntil([&] {
    disparity.publish(scene_.disparityMessage(header()));
    return spinUntil([&] { return reports_.statusHas("new_camera_planes", trouble); }, 0.1);
  })) << reports_.status("new_camera_planes");
  EXPECT_TRUE(reports_.logged(rosgraph_msgs::Log::WARN, trouble));
  EXPECT_TRUE(planes.messages.empty());
  info.publish(test::cameraInfo(scene_.camera, false, header()));
  expectFront(answer([&] { disparity.publish(scene_.disparityMessage(header())); }, planes), scene_);
}

TEST_F(PlanesNodelet, WaitsForImagesThatComeLate) {
  // As from a bag: the images of a frame arrive after its disparity.
  const ros::Publisher left = nh_.advertise<sensor_msgs::Image>("left/image_rect", 10);
  const ros::Publisher right = nh_.advertise<sensor_msgs::Image>("right/image_rect", 10);
  ASSERT_TRUE(spinUntil([&] { return left.getNumSubscribers() > 0 && right.getNumSubscribers() > 0; }));
  const auto publishImages = [&](const std_msgs::Header& h) {
    for (const ros::Publisher& side : {left, right}) side.publish(test::greyImage(320, 240, h, [](int, int) { return 50; }));
  };
  std_msgs::Header first;
  const PlaneArray before = answer([&] { publish(scene_.disparityMessage(first = header())); }, planes_);
  EXPECT_FALSE(before.header.stamp.isZero()) << "images that never come are not waited for longer than until the next frame";
  EXPECT_LT(before.header.stamp, first.stamp) << "no image has come yet, but they are offered";
  publishImages(first);
  ASSERT_TRUE(spinUntil([&] { return planes_.messages.back()->header.stamp == first.stamp; }));
  planes_.messages.clear();
  const std_msgs::Header late = header();
  publish(scene_.disparityMessage(late));
  test::spinFor(0.5);
  EXPECT_TRUE(planes_.messages.empty()) << "the images may still come";
  publishImages(late);
  ASSERT_TRUE(spinUntil([&] { return !planes_.messages.empty(); }));
  EXPECT_EQ(planes_.messages[0]->header.stamp, late.stamp);
  const std_msgs::Header without = header();
  publish(scene_.disparityMessage(without));
  publish(scene_.disparityMessage(header()));
  ASSERT_TRUE(spinUntil([&] { return planes_.messages.size() > 1; })) << "the next frame ends the waiting";
  EXPECT_EQ(planes_.messages[1]->header.stamp, without.stamp);
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "planes_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
