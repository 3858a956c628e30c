// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "cabinet_articulation/stereo/depth_frame.h"
#include "simulation/cabinet_scenes.h"
#include "simulation/stereo_renderer.h"

namespace cabinet_articulation {
namespace test {

inline const core::StereoCamera kKinect{640, 480, 525, 525, 319.5, 239.5, 0.075, 0};

/// A kitchen as a depth camera sees it that bends what is flat.
class BentKitchen {
 public:
  BentKitchen() {
    core::SimulationConfig config;
    config.scene = "door";
    scene_ = core::makeScene(config);
    config.shadows = false;
    renderer_ = std::make_unique<core::StereoRenderer>(config, kKinect);
  }

  void openDoor(double angle) { angle_ = angle; }
  void bend(const cv::Mat1f& bend) { bend_ = bend; }

  /// With a Kinect's noise and steps of 1/8 px.
  core::DepthFrame seenFrom(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
    const Eigen::Isometry3d T_camera_world = core::lookAt(eye, target).inverse();
    std::vector<core::Surface> surfaces = scene_.surfacesAt({angle_});
    for (core::Surface& surface : surfaces) surface.rectangle.pose = T_camera_world * surface.rectangle.pose;
    const cv::Mat1f& depth = renderer_->render(surfaces).depth;
    core::DepthFrame frame{kKinect, cv::Mat1f(depth.size(), 0.0F), {}, {}};
    for (int v = 0; v < depth.rows; ++v)
      for (int u = 0; u < depth.cols; ++u) {
        if (!(depth(v, u) > 0)) continue;
        const double exact = kKinect.disparity(depth(v, u)) + (bend_.empty() ? 0 : bend_(v, u));
        frame.disparity(v, u) = static_cast<float>(std::round((exact + random_.gaussian(0.1)) * 8) / 8);
      }
    return frame;
  }

  /// A camera that is carried about and looks around.
  core::DepthFrame onTour(int i) {
    const double t = 0.1 * i;
    const Eigen::Vector3d eye(1.3 * std::sin(0.37 * t), -1.7 + 0.6 * std::sin(0.61 * t + 1), 1.2 + 0.4 * std::sin(0.83 * t + 2));
    const Eigen::Vector3d target(eye.x() + 1.2 * std::sin(0.71 * t), 0, 0.9 + 0.8 * std::sin(0.53 * t));
    return seenFrom(eye, target);
  }

 private:
  core::Scene scene_;
  std::unique_ptr<core::StereoRenderer> renderer_;
  double angle_ = 0;  ///< [rad] of the door
  cv::Mat1f bend_;    ///< [px]
  cv::RNG random_{1};
};

/// A dome of 1 px in the middle of the image, which no polynomial is, without the plane that fits it best.
inline cv::Mat1f dome() {
  cv::Mat1f image(kKinect.height, kKinect.width);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) {
      const double x = u / 320.0 - 1, y = v / 240.0 - 1;
      image(v, u) = static_cast<float>(std::exp(-(x * x + y * y)));
    }
  return image - cv::mean(image)[0];
}

}  // namespace test
}  // namespace cabinet_articulation
