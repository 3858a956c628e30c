// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/geometry/stereo_camera.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "cabinet_articulation/geometry/limits.h"

namespace cabinet_articulation::core {
namespace {

void require(bool holds, const char* name, double value, const char* expected) {
  if (holds) return;
  std::ostringstream text;
  text << name << " is " << value << ", expected " << expected;
  throw std::invalid_argument(text.str());
}

void requireIntrinsics(const StereoCamera& camera, const char* fx_name, const char* fy_name) {
  require(std::isfinite(camera.fx) && camera.fx > 0, fx_name, camera.fx, "a positive focal length (is the camera calibrated?)");
  require(std::isfinite(camera.fy) && camera.fy > 0, fy_name, camera.fy, "a positive focal length (is the camera calibrated?)");
}

void requireSane(const StereoCamera& camera) {
  requireWithin("width", camera.width, limits::kImageSide);
  requireWithin("height", camera.height, limits::kImageSide);
  requireWithin("focal length fx (P[0])", camera.fx, limits::kFocalLength);
  requireWithin("focal length fy (P[5])", camera.fy, limits::kFocalLength);
  requireWithin("principal point cx (P[2])", camera.cx, limits::kPrincipalPoint);
  requireWithin("principal point cy (P[6])", camera.cy, limits::kPrincipalPoint);
  requireWithin("right camera's baseline (-P[3] / P[0])", camera.baseline, limits::kBaseline);
  requireWithin("right camera's cx (left P[2] - right P[2])", camera.cx_difference, limits::kPrincipalPoint);
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
  require(std::isfinite(P_right[0]) && P_right[0] > 0, "right P[0]", P_right[0],
          "a positive focal length (is the camera calibrated?)");
  require(std::isfinite(P_right[3]) && P_right[3] < 0, "right P[3]", P_right[3],
          "-fx * baseline, a negative number (is the right camera calibrated as part of a stereo pair?)");
  camera.baseline = -P_right[3] / P_right[0];
  camera.cx_difference = P_left[2] - P_right[2];
  requireSane(camera);
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
  requireSane(camera);
  return camera;
}

bool StereoCamera::isSane() const {
  try {
    requireSane(*this);
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

Eigen::Vector3d StereoCamera::point(double u, double v, double disparity) const { return depth(disparity) * ray(u, v); }

}  // namespace cabinet_articulation::core
