// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "cabinet_articulation/planes/plane_region.h"
#include "cabinet_articulation/planes/planes_config.h"
#include "cabinet_articulation/planes/region_growing.h"
#include "cabinet_articulation/stereo/depth_frame.h"

namespace cabinet_articulation::core {

/// Eq. (2) for every pixel, with the tolerance that follows the noise, and with `kOtherPlane` (ours): without it a door
/// grows over the neighbour that its plane cuts.
class PlaneMask {
 public:
  explicit PlaneMask(const PlanesConfig& config);

  /// The regions that compete for pixels in the following calls of label().
  void setFrame(const DepthFrame& frame, const RegionSet& set);

  /// [px] the smallest residual of the regions that hold a pixel, plus `other_plane_margin`; huge outside all regions.
  const cv::Mat1f& competitor() const { return competitor_; }

  /// The labels of `plane` in fresh memory.
  cv::Mat1b label(const DepthFrame& frame, const DisparityPlane& plane) const;

 private:
  PlanesConfig config_;
  cv::Mat1f competitor_;  ///< [px] residual that a pixel must exceed to belong to another region's plane; huge outside
};

/// Eq. (2) as the paper has it: within `distance` [m] of the plane, measured along its normal.
cv::Mat1b labelByDistance(const DepthFrame& frame, const Plane& plane, double distance);

}  // namespace cabinet_articulation::core
