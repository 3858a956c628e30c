// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "cabinet_articulation/stereo/block_matcher.h"

namespace cabinet_articulation {

/// One measurement in files: a depth image, a disparity image, or a pair.
struct ImageInput {
  std::string kind;                 ///< depth, disparity or stereo; empty: stereo for two images, else depth
  std::vector<std::string> images;  ///< one, or left and right
  std::string info, right_info;     ///< calibrations as camera_calibration writes them (YAML); empty: the numbers below
  double fx = 0, fy = 0;            ///< [px] of rectified images; fy = 0: as fx
  double cx = -1, cy = -1;          ///< [px] negative: the image's centre
  double baseline = 0;              ///< [m] of a pair or a disparity without a right calibration
  double scale = 0;                 ///< 16 bit values per metre or per pixel of disparity; 0: 1000, or 256
};

/// Reads the files; a pair with calibrations is rectified, and matched. Throws std::invalid_argument for what the user should
/// have said, and std::runtime_error that names the file that cannot be used.
core::DepthFrame readFrame(const ImageInput& input, const core::StereoConfig& config);

}  // namespace cabinet_articulation
