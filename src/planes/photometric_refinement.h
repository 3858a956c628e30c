// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "cabinet_articulation/planes/planes_config.h"
#include "cabinet_articulation/stereo/depth_frame.h"
#include "planes/region_growing.h"

namespace cabinet_articulation::core {

/// Fits each region's plane to the two images themselves (ours): Gauss-Newton on a robust sum of squares of
///
///   L(u, v) - gain R(u - disparity(u, v), v + row_shift) - offset,     disparity(u, v) = a u + b v + c
///
/// Block matching's errors are correlated over its window, so a small front holds only a few independent disparities,
/// while its pixels hold thousands. The row shift takes up a rectification that is off by a fraction of a pixel, which
/// real calibrations are; without it the errors double.
class PhotometricRefinement {
 public:
  explicit PhotometricRefinement(const PlanesConfig& config);

  /// Replaces the planes of `set`. A region keeps its plane if its pixels tell less about it than block matching did, or if
  /// the result would lie further than `refine_max_shift` from it anywhere in the region. Pixels whose residual exceeds
  /// `limit` [px, for each pixel] belong to another surface and are not used.
  void process(const DepthFrame& frame, const cv::Mat1f& limit, RegionSet* set);

 private:
  /// disparity = a x + b y + c in the samples' coordinates.
  struct Estimate {
    double a, b, c, row_shift, gain, offset;
  };
  /// Pixels of a region. x and y are relative to its centre and scaled to +-1, which keeps sums in float well
  /// conditioned. The number is a multiple of the sums' lanes; what was added for that has `inside` 0.
  struct Samples {
    std::vector<int> row;
    std::vector<float> u, x, y, left, slope, inside;                   ///< slope: of the left image, along u
    std::vector<float> right, gradient, row_gradient, residual, seen;  ///< of the current estimate; seen: not off the image
    void resize(size_t n);
    size_t size() const { return u.size(); }
  };
  struct Step;

  std::optional<DisparityPlane> refine(const DepthFrame& frame, const cv::Mat1f& limit, const GrownRegion& region,
                                       const RegionSet& set);
  void takeSamples(const DepthFrame& frame, const cv::Mat1f& limit, const GrownRegion& region, const RegionSet& set);
  void describeSamples(size_t n);
  void warp(const Estimate& estimate);
  float noise();
  std::optional<Step> step(double gain, float sigma) const;

  PlanesConfig config_;
  cv::Mat1b left_, right_;
  double cx_difference_ = 0;
  double center_u_ = 0, center_v_ = 0, scale_ = 1;
  Samples samples_;
  std::vector<float> sorted_;
};

}  // namespace cabinet_articulation::core
