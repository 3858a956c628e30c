// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "cabinet_articulation/planes/plane_region.h"
#include "cabinet_articulation/stereo/depth_frame.h"
#include "planes/disparity_tolerance.h"

namespace cabinet_articulation::core {
namespace detail {
struct RowPlane;
}

/// Eq. (2) for every pixel, with a tolerance that follows the noise. In-plane pixels whose residual exceeds `limit` [px] are
/// `kOtherPlane` (ours): without that label a door grows over the neighbour that its plane cuts.
///
/// Most blocks of an image lie as a whole before or behind a given plane, which the range of their disparities tells (ours).
class NoiseMask {
 public:
  /// Both images must stay alive and unchanged while masks are labelled.
  void setFrame(const cv::Mat1f& disparity, const DisparityTolerance& tolerance, const cv::Mat1f& limit);

  /// Uses the memory of `mask` again if it has the size of the disparity.
  void label(const DisparityPlane& plane, cv::Mat1b* mask) const;

 private:
  /// Of the measured pixels of a block; the smallest is infinite and the largest negative if there are none.
  struct Range {
    float least, most, tolerance;
  };

  /// Of what was measured in blocks, as seen from a plane.
  enum class Place { kBehind, kAcross, kBefore };

  void addBand(int top, int bottom, const DisparityTolerance& tolerance);
  static Place placeOf(const Range& range, const detail::RowPlane& first, const detail::RowPlane& last, int begin, int end);
  void labelBlocks(const DisparityPlane& plane, Place place, const cv::Rect& box, cv::Mat1b* mask) const;

  cv::Mat1f disparity_, limit_;
  cv::Mat1f tolerance_;        ///< [px] negative where nothing was measured
  cv::Mat1b free_, occluded_;  ///< the labels of planes that lie behind or before everything
  std::vector<Range> ranges_;  ///< of each block, row by row
  std::vector<float> least_, most_;
};

/// Eq. (2) as the paper has it: in-plane is within `distance` [m] of the plane, measured along its normal (Eq. 1).
void labelByDistance(const DepthFrame& frame, const Plane& plane, double distance, cv::Mat1b* mask);

}  // namespace cabinet_articulation::core
