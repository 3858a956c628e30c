// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "cabinet_articulation/geometry/rectangle.h"
#include "cabinet_articulation/planes/plane_region.h"
#include "cabinet_articulation/stereo/depth_frame.h"

namespace cabinet_articulation::core {

/// A 640x480 pair like the paper's: f = 690 px, baseline 9 cm.
inline StereoCamera exampleCamera() {
  StereoCamera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 690;
  camera.cx = 318;
  camera.cy = 243;
  camera.baseline = 0.09;
  return camera;
}

/// A front at `center` whose normal leans away from the line of sight by `yaw` (about the vertical) and `pitch`, turned
/// by `roll` about its normal [rad].
inline Rectangle exampleFront(const Eigen::Vector3d& center, double width, double height, double yaw, double pitch, double roll) {
  Rectangle front;
  front.pose.translation() = center;
  front.pose.linear() =
      (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(M_PI + pitch, Eigen::Vector3d::UnitX()) *
       Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()))
          .toRotationMatrix();
  front.width = width;
  front.height = height;
  return front;
}

/// The pixel centres (left image) that see a rectangle.
inline cv::Mat1b footprint(const Rectangle& rectangle, const StereoCamera& camera) {
  cv::Mat1b result(camera.height, camera.width, std::uint8_t{0});
  const Eigen::Isometry3d to_rectangle = rectangle.pose.inverse();
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const auto p = rectangle.plane().intersect(camera.ray(u, v));
      if (!p) continue;
      const Eigen::Vector3d local = to_rectangle * *p;
      result(v, u) = std::abs(local.x()) <= rectangle.width / 2 && std::abs(local.y()) <= rectangle.height / 2 ? 255 : 0;
    }
  return result;
}

/// The region that a perfect planes stage reports for a front before a free background. Masks may then be painted over;
/// call `finishRegion` afterwards.
inline PlaneRegion frontRegion(const Rectangle& front, const StereoCamera& camera) {
  PlaneRegion region;
  region.plane = front.plane();
  region.disparity_plane = *toDisparityPlane(region.plane, camera);
  region.mask = cv::Mat1b(camera.height, camera.width, std::uint8_t{kFree});
  region.mask.setTo(kInPlane, footprint(front, camera));
  return region;
}

/// Inliers and hull of what is in-plane now.
inline PlaneRegion finishRegion(PlaneRegion region) {
  std::vector<cv::Point> pixels;
  cv::findNonZero(region.mask == kInPlane, pixels);
  region.inliers = static_cast<int>(pixels.size());
  std::vector<cv::Point> hull;
  if (!pixels.empty()) cv::convexHull(pixels, hull);
  region.hull.assign(hull.begin(), hull.end());
  return region;
}

/// Something with a random black and white grid on it, as an active stereo camera sees it.
struct TexturedRectangle {
  Rectangle rectangle;
  std::uint32_t seed = 0;
};

/// Nearest surface along each pixel's ray, 2x2 samples a pixel; `right` renders from the right camera.
inline cv::Mat1b renderView(const std::vector<TexturedRectangle>& surfaces, const StereoCamera& camera, bool right) {
  constexpr double kCell = 0.004;  // [m] some two pixels at 1.4 m
  constexpr int kSamples = 2;
  const Eigen::Vector3d eye(right ? camera.baseline : 0, 0, 0);
  std::vector<Eigen::Isometry3d> to_surface;
  for (const TexturedRectangle& surface : surfaces) to_surface.push_back(surface.rectangle.pose.inverse());
  cv::Mat1b image(camera.height, camera.width);
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      double sum = 0;
      for (int s = 0; s < kSamples * kSamples; ++s) {
        const double du = (s % kSamples + 0.5) / kSamples - 0.5;
        const double dv = (s / kSamples + 0.5) / kSamples - 0.5;
        const Eigen::Vector3d ray = camera.ray(u + du + (right ? camera.cx_difference : 0), v + dv);
        double nearest = 1e9;
        double shade = 30;
        for (size_t i = 0; i < surfaces.size(); ++i) {
          const Eigen::Vector3d origin = to_surface[i] * eye;
          const Eigen::Vector3d direction = to_surface[i].linear() * ray;
          const double depth = -origin.z() / direction.z();
          const Eigen::Vector3d p = origin + depth * direction;
          const Rectangle& r = surfaces[i].rectangle;
          if (!(depth > 0 && depth < nearest) || std::abs(p.x()) > r.width / 2 || std::abs(p.y()) > r.height / 2) continue;
          nearest = depth;
          // Any mixing of the cell's place serves; the constants are large odd numbers.
          const auto x = static_cast<std::uint32_t>(std::lround(std::floor(p.x() / kCell)));
          const auto y = static_cast<std::uint32_t>(std::lround(std::floor(p.y() / kCell)));
          std::uint32_t hash = (x * 2654435761U) ^ (y * 2246822519U) ^ (surfaces[i].seed * 3266489917U);
          hash = (hash ^ (hash >> 15)) * 2246822519U;
          hash ^= hash >> 13;
          shade = (hash & 1) != 0 ? 180 : 40;
        }
        sum += shade;
      }
      image(v, u) = cv::saturate_cast<std::uint8_t>(sum / (kSamples * kSamples));
    }
  return image;
}

/// Largest distance between corners, whatever the order of axes [m].
inline double cornerError(const Rectangle& truth, const Rectangle& estimate) {
  const Rectangle aligned = alignDescription(estimate, truth, false);
  double worst = 0;
  for (int i = 0; i < 4; ++i) worst = std::max(worst, (truth.corners()[i] - aligned.corners()[i]).norm());
  return worst;
}

}  // namespace cabinet_articulation::core
