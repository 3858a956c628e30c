// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "cabinet_articulation/planes/plane_region.h"
#include "cabinet_articulation/stereo/depth_frame.h"
#include "rectangles/chart/image_edge.h"

namespace cabinet_articulation::core {

/// How well left and right image agree near one edge of a rectangle, in strips parallel to it and for several depths
/// (ours). Strips on the plane match where the plane predicts; beyond the edge they match at another disparity, or not at
/// all. Other than the disparity image, whose windows blend both sides of an edge, each strip stands for itself: it is
/// half a pixel wide and as long as the edge.
class EdgeProfile {
 public:
  static constexpr double kStripWidth = 0.5;  ///< [px]
  static constexpr double kInside = 16;       ///< [px] covered inside the edge
  static constexpr double kOutside = 8;       ///< [px] covered outside
  static constexpr int kStrips = static_cast<int>((kInside + kOutside) / kStripWidth);
  static constexpr int kOffsets = 7;  ///< disparities tried, a pixel apart, the plane's own in the middle
  static constexpr int kOnPlane = kOffsets / 2;

  /// What the strips of an edge, or of half of it, say.
  struct Residuals {
    /// 1 - zero-mean normalised correlation of each strip, innermost first, at the plane's disparity + (i - kOnPlane) px.
    std::array<std::array<float, kOffsets>, kStrips> residual;
    std::array<float, kStrips> weight;  ///< [0..1] share of the pixels that a full strip has
    std::array<float, kStrips> signal;  ///< [grey levels] what both images share on the plane: the root of their covariance
  };

  /// Pixels that the region's mask calls occluded are left out.
  EdgeProfile(const DepthFrame& frame, const PlaneRegion& region, const ImageEdge& edge);

  Residuals whole() const;
  Residuals half(int index) const;  ///< 0: from the edge's end `a` to its middle; 1: from there to `b`

  /// Offset [px] of a strip's inner border from the edge, positive outward.
  static double offset(double strip) { return strip * kStripWidth - kInside; }

 private:
  /// Sums over the pixels of a strip: of the left image l and, for each disparity, of the right image r.
  struct Moments {
    static constexpr int kLanes = 8;  ///< kOffsets, padded for vector registers
    float r[kLanes] = {}, rr[kLanes] = {}, lr[kLanes] = {};
    float n = 0, l = 0, ll = 0;

    void add(const Moments& other);
    /// Of l and r for each disparity, with `kNoiseVariance` added to both variances.
    void correlate(float* covariance, float* correlation) const;
  };
  struct Row;
  class OpenStrip;
  static void addPixels(const Row& row, int u_begin, int u_end, const float* right, int first_column, Moments* strips);
  static void addRow(const Row& row, int u_begin, int u_end, Moments* halves[2]);
  static Residuals residuals(const std::array<Moments, kStrips>& strips);

  std::array<std::array<Moments, kStrips>, 2> halves_{};
};

}  // namespace cabinet_articulation::core
