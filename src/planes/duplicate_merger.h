// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "cabinet_articulation/planes/planes_config.h"
#include "planes/region_growing.h"

namespace cabinet_articulation::core {

/// Masks of planes overlap, so one surface can be found twice. Of regions that share cells and whose planes agree over the
/// smaller one, only the largest stays.
class DuplicateMerger {
 public:
  explicit DuplicateMerger(const PlanesConfig& config) : config_(config) {}

  /// Drops duplicates, orders the rest by size and keeps the `max_regions` largest.
  void process(cv::Size image, RegionSet* set);

 private:
  bool isDuplicate(const GrownRegion& region, const RegionSet& set);

  PlanesConfig config_;
  cv::Mat1i owner_;  ///< index of the largest region of each cell, or -1
  std::vector<int> shared_;
  std::vector<GrownRegion> kept_;
};

}  // namespace cabinet_articulation::core
