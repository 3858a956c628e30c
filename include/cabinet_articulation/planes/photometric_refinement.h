// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "cabinet_articulation/planes/planes_config.h"
#include "cabinet_articulation/planes/region_growing.h"
#include "cabinet_articulation/stereo/depth_frame.h"

namespace cabinet_articulation::core {

/// Fits a region's plane to the two images themselves (ours): Gauss-Newton on a, b, c, a gain g and an offset o over
/// sum of L(u, v) - g R(u - disparity(u, v), v) - o, with Huber weights. Block matching's errors are correlated over its
/// window, so a small front holds only a few independent disparities; its pixels hold thousands.
class PhotometricRefinement {
 public:
  explicit PhotometricRefinement(const PlanesConfig& config);

  /// The images that the following calls of refine() compare.
  void setFrame(const DepthFrame& frame);

  /// The better plane; nothing if the region has too little texture, lies outside the right image, or if the result would
  /// move further than `refine_max_shift` from `region.plane` anywhere in the region.
  std::optional<DisparityPlane> refine(const GrownRegion& region, const RegionSet& set);

 private:
  /// Pixels of the region. `x` and `y` are relative to the region's centre and scaled to +-1, which keeps sums in float
  /// well conditioned. The number is a multiple of the lanes of the sums; what was added has weight 0.
  struct Samples {
    std::vector<float> u, x, y, left, slope;               ///< fixed: pixel, place, left image and its slope along u
    std::vector<float> right, gradient, residual, weight;  ///< of the current estimate
    std::vector<int> row;
    void clear();
    void resize(size_t n);
    size_t size() const { return u.size(); }
  };
  /// disparity = a x + b y + c in the samples' coordinates; left = gain right + offset.
  struct Estimate {
    double a, b, c, gain, offset;
  };
  using Step = Eigen::Matrix<double, 5, 1>;

  void takeSamples(const GrownRegion& region, const RegionSet& set);
  void warp(const Estimate& estimate);
  double weigh();
  std::optional<Step> solve(double gain) const;
  double largestShift(const GrownRegion& region, const RegionSet& set, const DisparityPlane& plane) const;

  PlanesConfig config_;
  cv::Mat1f left_, right_;
  double cx_difference_ = 0;
  double center_u_ = 0, center_v_ = 0, scale_ = 1;
  Samples samples_;
  std::vector<float> sorted_;
};

}  // namespace cabinet_articulation::core
