// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "cabinet_articulation/config/config.h"
#include "cabinet_articulation/stereo/depth_frame.h"

namespace cabinet_articulation::core {

/// Block matching as OpenCV's StereoBM does it. Fields are named as in stereo_image_proc. The defaults are the paper's (128
/// disparities, 15 Hz), and windows that were measured best for small fronts (15x15; 9x9 loses doors).
struct StereoConfig {
  std::string matcher = "own";
  int disparity_range = 128;         ///< [px]
  int min_disparity = 0;             ///< [px]
  int correlation_window_size = 15;  ///< [px]
  int prefilter_size = 9;            ///< [px]
  int prefilter_cap = 31;
  int texture_threshold = 10;
  double uniqueness_ratio = 15;  ///< [%] the paper's ambiguity test (III-A)
  int speckle_size = 100;        ///< [px]
  int speckle_range = 4;         ///< [px]
  bool recover_left_band = true;
  bool leave_out_unlit = true;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("matcher", self.matcher, Choices{"own", "opencv"},
          "opencv: StereoBM; own: the same disparities in about half of its time, and StereoBM where windows are too large "
          "(above 21 px at the "
          "default cap)");
    visit("disparity_range", self.disparity_range, Range{16, 1024}, "px", "number of disparities searched, a multiple of 16");
    visit("min_disparity", self.min_disparity, Range{-1024, 1024}, "px", "smallest disparity searched");
    visit("correlation_window_size", self.correlation_window_size, Range{5, 255}, "px", "side of the matched block, odd");
    visit("prefilter_size", self.prefilter_size, Range{5, 255}, "px", "window of the texture prefilter, odd");
    visit("prefilter_cap", self.prefilter_cap, Range{1, 63}, "", "truncation of the prefiltered gradient");
    visit("texture_threshold", self.texture_threshold, Range{0, 10000}, "", "least texture of a block");
    visit("uniqueness_ratio", self.uniqueness_ratio, Range{0, 100}, "%",
          "margin of the best over the second-best match (paper, III-A: ambiguity test)");
    visit("speckle_size", self.speckle_size, Range{0, 100000}, "px", "smaller isolated patches of disparity are dropped");
    visit("speckle_range", self.speckle_range, Range{0, 1000}, "px", "disparity step that separates two patches");
    visit("recover_left_band", self.recover_left_band,
          "also match the leftmost columns, by padding both images (ours: StereoBM leaves disparity_range columns empty)");
    visit("leave_out_unlit", self.leave_out_unlit,
          "leave out frames without the projector's pattern where it is on in others again and again (alternating emitter)");
  }
};

/// Rectified pair -> disparity. Deterministic; buffers are kept between frames.
class BlockMatcher {
 public:
  /// Throws ConfigError (range, or an even window, or a disparity range that is no multiple of 16).
  explicit BlockMatcher(const StereoConfig& config);
  ~BlockMatcher();

  /// Left and right must be CV_8UC1 and of the camera's size, else std::invalid_argument with both in words.
  /// Returns CV_32FC1 disparities [px], already free of camera.cx_difference, 0 where there is no match. The result is
  /// nobody else's memory: it stays valid and unchanged after the next call. `left` and `right` of the frame share the inputs.
  DepthFrame process(const cv::Mat& left, const cv::Mat& right, const StereoCamera& camera);

  const StereoConfig& config() const { return config_; }

 private:
  cv::Mat1s match(const cv::Mat& left, const cv::Mat& right);

  struct Buffers;
  StereoConfig config_;
  std::unique_ptr<Buffers> buffers_;
};

/// Depth image (CV_32FC1 in metres, or CV_16UC1 in `unit` metres) -> the same kind of frame, without images. 0, negative numbers,
/// NaN and infinities mean that nothing was measured. Throws std::invalid_argument for another type, or a size that differs from
/// the camera's.
DepthFrame frameFromDepth(const cv::Mat& depth, const StereoCamera& camera, double unit = 1e-3);

}  // namespace cabinet_articulation::core
