// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace cabinet_articulation::core {

/// Label masks whose memory is lent again once nobody holds them any more (ours: the masks of one frame are some 6 MB).
class MaskPool {
 public:
  /// Masks beyond `capacity` that are in use at once are lent too, but their memory does not come back.
  explicit MaskPool(size_t capacity) : capacity_(capacity) {}

  /// A mask of undefined contents that nobody else holds.
  cv::Mat1b take(cv::Size size);

 private:
  size_t capacity_;
  std::vector<cv::Mat1b> masks_;
};

}  // namespace cabinet_articulation::core
