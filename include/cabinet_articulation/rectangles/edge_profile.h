// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "cabinet_articulation/rectangles/image_edge.h"
#include "cabinet_articulation/stereo/depth_frame.h"

namespace cabinet_articulation::core {

/// How well left and right image agree on a plane, in strips parallel to one edge of a rectangle (ours). Where the
/// strips lie on the plane, the right image shows what the plane predicts; beyond the edge it does not. Other than the
/// disparity image, whose windows blend both sides, each strip stands for itself.
class EdgeProfile {
 public:
  static constexpr double kStripWidth = 0.5;  ///< [px]
  static constexpr double kInside = 10;       ///< [px] covered inside the edge
  static constexpr double kOutside = 8;       ///< [px] covered outside the edge
  static constexpr int kStrips = static_cast<int>((kInside + kOutside) / kStripWidth);

  EdgeProfile(const DepthFrame& frame, const DisparityPlane& plane, const ImageEdge& edge);

  /// The zero-mean normalised correlation of each strip, innermost first; 0 for a strip with too few pixels.
  using Correlations = std::array<double, kStrips>;
  Correlations correlations() const;
  Correlations correlationsOfHalf(int half) const;

  /// Offset [px] of a strip's outer border from the edge, positive outward.
  static double offset(int strip) { return (strip + 1) * kStripWidth - kInside; }

 private:
  struct Moments {
    float n = 0, l = 0, r = 0, ll = 0, rr = 0, lr = 0;
  };
  static Moments sum(const Moments& a, const Moments& b);
  static double correlation(const Moments& m);

  std::array<std::array<Moments, kStrips>, 2> halves_;
};

/// The best division of a profile into an inner and an outer level.
struct EdgeStep {
  double offset = 0;   ///< [px] outward from where the edge was
  double inside = 0;   ///< level inside the edge
  double outside = 0;  ///< level outside
};
EdgeStep fitStep(const EdgeProfile::Correlations& correlations);

}  // namespace cabinet_articulation::core
