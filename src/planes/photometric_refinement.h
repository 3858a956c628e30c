// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "cabinet_articulation/planes/planes_config.h"
#include "cabinet_articulation/stereo/depth_frame.h"
#include "planes/refinement_samples.h"
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

  /// The same in two steps, for several sets of one frame.
  void setImages(const DepthFrame& frame);
  void refine(const DepthFrame& frame, const cv::Mat1f& limit, RegionSet* set);

 private:
  struct Step;

  std::optional<DisparityPlane> refined(const DepthFrame& frame, const cv::Mat1f& limit, const GrownRegion& region,
                                        const RegionSet& set);
  std::optional<Step> step(double gain, float sigma) const;

  PlanesConfig config_;
  cv::Mat1b left_, right_;
  double cx_difference_ = 0;
  RefinementSamples samples_;
};

}  // namespace cabinet_articulation::core
