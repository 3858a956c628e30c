// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "cabinet_articulation/planes/planes_config.h"
#include "cabinet_articulation/stereo/depth_frame.h"
#include "planes/region_growing.h"

namespace cabinet_articulation::core {

/// Which pixels belong to whom. Planes are infinite, so a region's plane also fits a stripe of every surface it cuts; such
/// pixels are the other surface's (ours: regions compete only with their own pixels, because rough infinite planes would
/// take pixels from good small ones).
class RegionCompetition {
 public:
  explicit RegionCompetition(const PlanesConfig& config);

  /// For each pixel the largest residual [px] with which it may count as a plane's own: the smallest residual among the
  /// regions that hold it plus `other_plane_margin`; huge where no region is. Valid until the next call.
  const cv::Mat1f& process(const cv::Mat1f& disparity, const RegionSet& set);

  /// The same for each cell, from the disparities of the cells. Valid until the next call.
  const cv::Mat1f& processCells(const cv::Mat1f& cells, const RegionSet& set);

 private:
  void compete(const cv::Mat1f& values, int spacing, const RegionSet& set, cv::Mat1f* limit) const;

  PlanesConfig config_;
  cv::Mat1f limit_, cell_limit_;
};

}  // namespace cabinet_articulation::core
