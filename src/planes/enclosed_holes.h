// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "planes/connected_runs.h"

namespace cabinet_articulation::core {

/// Labels the free pixels that a region encloses `kHole` (ours). The pane of a glass door and the mouth of an oven are no
/// evidence against the frame around them. A pixel is enclosed if no way leads from it out of the region's hull through free
/// pixels and those without a measurement. Less than kHollowShare of the hull is no hole.
class EnclosedHoles {
 public:
  /// `hull` [px]: of the region, which has `inliers` pixels.
  void label(const std::vector<cv::Point2f>& hull, int inliers, cv::Mat1b* mask);

 private:
  void findEnclosed(const cv::Size& box);

  cv::Mat1b ways_;  ///< 255 where a way may lead, within the box of a hull
  ConnectedRuns connected_;
  std::vector<CellRun> enclosed_;
};

}  // namespace cabinet_articulation::core
