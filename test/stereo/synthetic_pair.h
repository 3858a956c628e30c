// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "cabinet_articulation/geometry/plane.h"

namespace cabinet_articulation::core {

/// A camera with round numbers for tests of the image-based stages.
inline StereoCamera testCamera(int width = 640, int height = 480) {
  StereoCamera camera;
  camera.width = width;
  camera.height = height;
  camera.fx = 690;
  camera.fy = 685;
  camera.cx = width / 2.0 + 3;
  camera.cy = height / 2.0 - 4;
  camera.baseline = 0.09;
  return camera;
}

/// A textured piece of a plane, given by its outline in the left image.
struct Patch {
  DisparityPlane plane;
  cv::Rect2d area;
};

/// Patches as an ideal stereo camera sees them: texture and disparities are analytic, the nearer patch hides the others.
class SyntheticPair {
 public:
  SyntheticPair(cv::Size size, std::vector<Patch> patches, double noise = 2, double cx_difference = 0)
      : size_(size), patches_(std::move(patches)), cx_difference_(cx_difference) {
    cv::RNG rng(7);
    left.create(size);
    right.create(size);
    disparity.create(size);
    for (int v = 0; v < size.height; ++v)
      for (int u = 0; u < size.width; ++u) {
        double seen = 0;
        left(v, u) = cv::saturate_cast<std::uint8_t>(shade(
                                                         u, v, [](const Patch&, double x) { return x; }, &seen) +
                                                     rng.gaussian(noise));
        disparity(v, u) = static_cast<float>(seen);
        // Right column x shows left column u where x = u - disparity(u, v) - cx_difference.
        const auto source = [this, v](const Patch& patch, double x) {
          return (x + cx_difference_ + patch.plane.b * v + patch.plane.c) / (1 - patch.plane.a);
        };
        right(v, u) = cv::saturate_cast<std::uint8_t>(0.9 * shade(u, v, source, &seen) + 8 + rng.gaussian(noise));
      }
  }

  cv::Mat1b left, right;  ///< the right camera has 0.9 of the left's gain and 8 grey levels more
  cv::Mat1f disparity;    ///< [px] exact

 private:
  template <class Source>
  double shade(int x, int v, const Source& source, double* seen) const {
    double value = 0;
    *seen = 0;
    for (size_t i = 0; i < patches_.size(); ++i) {
      const double u = source(patches_[i], x);
      const double d = patches_[i].plane.at(u, v);
      if (d <= *seen || !patches_[i].area.contains(cv::Point2d(u, v))) continue;
      *seen = d;
      value = texture(u, v, static_cast<std::uint32_t>(i));
    }
    return value;
  }

  static double random(int x, int y, std::uint32_t seed) {
    std::uint32_t h =
        seed * 668265263U + static_cast<std::uint32_t>(x) * 374761393U + static_cast<std::uint32_t>(y) * 2246822519U;
    h = (h ^ (h >> 15)) * 2654435761U;
    return ((h ^ (h >> 13)) & 0xFFFF) / 65535.0;
  }

  /// Random grey values on a grid of 3.5 px (the projector's cell), smoothly blended.
  static double texture(double u, double v, std::uint32_t seed) {
    const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
    const double x = u / 3.5 + 1000, y = v / 3.5 + 1000;
    const int xi = static_cast<int>(x), yi = static_cast<int>(y);
    const double fx = smooth(x - xi), fy = smooth(y - yi);
    const double top = (1 - fx) * random(xi, yi, seed) + fx * random(xi + 1, yi, seed);
    const double bottom = (1 - fx) * random(xi, yi + 1, seed) + fx * random(xi + 1, yi + 1, seed);
    return 40 + 160 * ((1 - fy) * top + fy * bottom);
  }

  cv::Size size_;
  std::vector<Patch> patches_;
  double cx_difference_;
};

}  // namespace cabinet_articulation::core
