// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/geometry/stereo_camera.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace cabinet_articulation::core {
namespace {

void require(bool holds, const char* name, double value, const char* expected) {
  if (holds) return;
  std::ostringstream text;
  text << name << " is " << value << ", expected " << expected;
  throw std::invalid_argument(text.str());
}

void requireIntrinsics(const StereoCamera& camera, const char* fx_name, const char* fy_name) {
  require(camera.width > 0, "width", camera.width, "the image's width");
  require(camera.height > 0, "height", camera.height, "the image's height");
  require(std::isfinite(camera.fx) && camera.fx > 0, fx_name, camera.fx, "a positive focal length (is the camera calibrated?)");
  require(std::isfinite(camera.fy) && camera.fy > 0, fy_name, camera.fy, "a positive focal length (is the camera calibrated?)");
  require(std::isfinite(camera.cx), "principal point cx", camera.cx, "a finite number");
  require(std::isfinite(camera.cy), "principal point cy", camera.cy, "a finite number");
}

}  // namespace

StereoCamera StereoCamera::fromProjections(int width, int height, const std::array<double, 12>& P_left,
                                           const std::array<double, 12>& P_right) {
  StereoCamera camera;
  camera.width = width;
  camera.height = height;
  camera.fx = P_left[0];
  camera.fy = P_left[5];
  camera.cx = P_left[2];
  camera.cy = P_left[6];
  requireIntrinsics(camera, "left P[0]", "left P[5]");
  require(std::isfinite(P_right[0]) && P_right[0] > 0, "right P[0]", P_right[0], "a positive focal length (is the camera calibrated?)");
  require(std::isfinite(P_right[3]) && P_right[3] < 0, "right P[3]", P_right[3],
          "-fx * baseline, a negative number (is the right camera calibrated as part of a stereo pair?)");
  camera.baseline = -P_right[3] / P_right[0];
  camera.cx_difference = P_left[2] - P_right[2];
  require(std::isfinite(camera.cx_difference), "right P[2]", P_right[2], "a finite number");
  return camera;
}

StereoCamera StereoCamera::fromDepthCamera(int width, int height, const std::array<double, 9>& K, double virtual_baseline) {
  StereoCamera camera;
  camera.width = width;
  camera.height = height;
  camera.fx = K[0];
  camera.fy = K[4];
  camera.cx = K[2];
  camera.cy = K[5];
  camera.baseline = virtual_baseline;
  requireIntrinsics(camera, "K[0]", "K[4]");
  require(std::isfinite(virtual_baseline) && virtual_baseline > 0, "virtual baseline", virtual_baseline, "a positive length");
  return camera;
}

Eigen::Vector3d StereoCamera::point(double u, double v, double disparity) const { return depth(disparity) * ray(u, v); }

}  // namespace cabinet_articulation::core
