// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace cabinet_articulation::core {

/// The result of OpenCV's filterSpeckles in a quarter of its time (ours): rows are joined run by run instead of pixel by pixel.
/// Memory is kept from call to call.
class SpeckleFilter {
 public:
  /// Sets the patches of at most `size` pixels to `unmatched`. A pixel and its neighbour (of four) belong to one patch if both
  /// are matched and differ by no more than `range` [px/16].
  void process(int size, int range, std::int16_t unmatched, cv::Mat1s* sixteenths);

 private:
  /// Pixels of a row, each of one patch with the next: [begin, end).
  struct Run {
    int row, begin, end;
    int parent;  ///< a run of the same patch; itself in a patch's first run
    int pixels;  ///< of the patch, in its first run
  };

  void appendRuns(int row);
  void joinRows(const std::int16_t* above, const std::int16_t* below, int range, int first_above, int first_below);
  void join(int a, int b);
  int root(int run);

  std::vector<Run> runs_;
  std::vector<std::uint8_t> matched_, joined_;  ///< of each pixel of a row: 255, or 0; joined: to the pixel before
};

}  // namespace cabinet_articulation::core
