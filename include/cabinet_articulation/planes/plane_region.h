// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "cabinet_articulation/geometry/plane.h"

namespace cabinet_articulation::core {

/// What a pixel says about a plane: Eq. (2) of the paper plus two (ours). `kOtherPlane`: in-plane, but inside another region and
/// nearer to that region's plane. `kHole`: free, but enclosed by the region. The values are those of Plane.msg and readable as a
/// picture.
enum Label : std::uint8_t { kFree = 0, kHole = 32, kUnknown = 64, kOtherPlane = 128, kOccluded = 192, kInPlane = 255 };

/// Share of a front from which on a hole makes it hollow (ours). Panes take half of their door and more, gaps of solid fronts
/// less.
constexpr double kHollowShare = 0.2;

/// One connected region of one plane. Masks of different regions overlap.
struct PlaneRegion {
  Plane plane;                     ///< in the left optical frame
  DisparityPlane disparity_plane;  ///< the same plane in the image
  int inliers = 0;                 ///< [px] size of the connected region
  std::vector<cv::Point2f> hull;   ///< [px] convex hull of the connected region
  cv::Mat1b mask;                  ///< a Label for every pixel of the left image
};

}  // namespace cabinet_articulation::core
