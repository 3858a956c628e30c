// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "cabinet_articulation/geometry/plane.h"
#include "cabinet_articulation/planes/planes_config.h"
#include "cabinet_articulation/stereo/depth_frame.h"

namespace cabinet_articulation::core {

/// Sequential RANSAC in the disparity image: the best plane is found, its pixels are removed, and so on (paper III-B.1).
/// Ours: samples are neighbours, so that a small front is hit as often as a large wall, and the tolerance follows the
/// noise. PCL draws and judges the hypotheses.
class PlaneConsensus {
 public:
  explicit PlaneConsensus(const PlanesConfig& config);
  ~PlaneConsensus();

  /// The planes in the order they were found, at most `max_planes`. Seeded anew for every frame.
  std::vector<DisparityPlane> process(const DepthFrame& frame);

 private:
  class Model;
  struct Search;
  PlanesConfig config_;
  std::unique_ptr<Search> search_;
};

}  // namespace cabinet_articulation::core
