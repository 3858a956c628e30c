// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "cabinet_articulation/stereo/block_matcher.h"
#include "stereo/sad_row.h"
#include "stereo/speckle_filter.h"

namespace cabinet_articulation::core {

/// Computes the disparities of OpenCV's StereoBM in 0.4 to 0.5 of its time, 0.55 to 0.7 without AVX2 (ours). They are equal bit
/// for bit wherever whole windows lie in both images. It works row by row, so that sums stay in the nearest caches. Threads get
/// stripes of rows; neither their number nor the kind of vectors changes a bit.
class SadMatcher {
 public:
  /// Whether a window's sum fits into 15 bits: the limits of StereoBM's own vectors.
  static bool supports(const StereoConfig& config);

  explicit SadMatcher(const StereoConfig& config);

  /// Rectified pair of one size -> disparities [px/16], (min_disparity - 1) * 16 where there is no match. With recover_left_band,
  /// the images continue to the left with their first column. The result is valid until the next call.
  const cv::Mat1s& compute(const cv::Mat1b& left, const cv::Mat1b& right);

 private:
  /// What one thread works on.
  struct Stripe {
    cv::Mat1s sums;
    cv::Mat1i column_texture, texture;
  };

  void resize(cv::Size size);
  SadRow prepare(Stripe* stripe) const;
  void match(const cv::Range& rows, Stripe* stripe);
  void updateTexture(const SadRow& row, Stripe* stripe) const;

  StereoConfig config_;
  int radius_, window_, largest_disparity_;  ///< [px]
  std::int16_t unmatched_;
  SadRowFunction match_row_;
  cv::Range columns_;       ///< that are matched
  int margin_ = 0;          ///< [px] left of column 0 in the filtered images
  cv::Mat1b left_, right_;  ///< filtered, with margins; their last row has no gradient
  std::vector<Stripe> stripes_;
  cv::Mat1s sixteenths_;
  SpeckleFilter speckle_filter_;
};

}  // namespace cabinet_articulation::core
