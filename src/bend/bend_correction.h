// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "bend/bend_basis.h"
#include "cabinet_articulation/stereo/depth_frame.h"
#include "stereo/image_pool.h"

namespace cabinet_articulation::core {

/// Takes a bend that is known from frames. The same bend gives the same bits, whoever does it.
class BendCorrection {
 public:
  /// Draws the bend for images of this size, if it is not the one that was drawn last.
  void prepare(cv::Size size, const BendVector& bend);

  /// [px] of the bend that was drawn last, anywhere in the image.
  double largest() const { return largest_; }

  /// The frame with its disparity less the bend; as it is if the bend is 0. Pixels are nobody else's, or the input's.
  DepthFrame process(const DepthFrame& frame, const BendVector& bend);

 private:
  BendBasis basis_;
  BendVector bend_ = BendVector::Zero();  ///< that of the image
  cv::Mat1f image_;                       ///< [px]
  double largest_ = 0;                    ///< [px] in the image
  ImagePool<cv::Mat1f> disparities_{2};   ///< a stage's own and one that is passed on
};

}  // namespace cabinet_articulation::core
