// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "cabinet_articulation/stereo/depth_frame.h"
#include "planes/region_growing.h"

namespace cabinet_articulation::core {

/// How the right image shows a plane. disparity = a x + b y + c in the coordinates of RefinementSamples.
struct PhotometricEstimate {
  double a, b, c, row_shift, gain, offset;
};

/// Pixels of a region, and what both images hold there. x and y are relative to the samples' centre and scaled to +-1, which
/// keeps sums in float well conditioned. The number is a multiple of kLanes; what was added for that has `inside` 0.
class RefinementSamples {
 public:
  /// The pixels of the right image about a sample.
  struct Corners {
    std::uint8_t up[2], down[2];
  };
  static constexpr int kLanes = 8;  ///< partial sums, fixed so that every processor adds in the same order

  /// At most about `most` pixels of the region. Pixels whose residual exceeds `limit` [px, for each pixel] are not taken.
  void take(const DepthFrame& frame, const cv::Mat1f& limit, int most, const GrownRegion& region, const RegionSet& set);

  /// Once after take(): what the left image holds.
  void describe(const cv::Mat1b& left);

  /// The right image at the samples' places, bilinear, and its derivatives.
  void warp(const cv::Mat1b& right, double cx_difference, const PhotometricEstimate& estimate);

  /// [grey levels] robust standard deviation of the residuals.
  float noise();

  size_t size() const { return u_.size(); }
  double centerU() const { return center_u_; }
  double centerV() const { return center_v_; }
  double scale() const { return scale_; }

  std::vector<float> x, y, slope;                                    ///< slope: of the left image, along u
  std::vector<float> right, gradient, row_gradient, residual, seen;  ///< of the last estimate; seen: not off the image

 private:
  void resize(size_t n);
  void measureExtent(size_t n);

  double center_u_ = 0, center_v_ = 0, scale_ = 1;
  std::vector<int> row_, place_;  ///< place: of the pixel up and left in the right image
  std::vector<float> u_, left_, inside_, fraction_;
  std::vector<Corners> corners_;
  std::vector<float> sorted_;
};

}  // namespace cabinet_articulation::core
