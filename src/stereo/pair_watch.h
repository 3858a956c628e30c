// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <opencv2/core.hpp>

#include "cabinet_articulation/stereo/block_matcher.h"

namespace cabinet_articulation::core {

/// Tells the frames of a camera whose projector is not on in every frame (ours; cameras with an alternating emitter).
///
/// The pattern shows as contrast between neighbouring pixels, relative to the brightness. Where the recent frames are of two
/// clearly distinct contrasts and change between them again and again, those of the lower one lack the pattern. A view that
/// changes, a light that is switched or a projector that fails goes from one contrast to another once, and is left alone.
class ProjectorWatch {
 public:
  /// Takes the left images (CV_8UC1) of all frames in their order. True if this one lacks the pattern that frames around it have.
  bool lacksPattern(const cv::Mat& left);

 private:
  std::deque<double> contrasts_;  ///< logarithms, the newest last
};

/// Tells a pair whose left and right topics are swapped (ours): it hardly matches as it is, and well the other way round.
class SwapWatch {
 public:
  /// Takes what a matcher made of each pair. Where there is hardly any disparity, the first frame and every 30th after it are
  /// matched again, so that a camera that sees nothing costs little more.
  bool looksSwapped(const DepthFrame& frame, BlockMatcher* matcher);

 private:
  int few_matches_ = 0;
};

}  // namespace cabinet_articulation::core
