// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/geometry/plane.h"
#include "cabinet_articulation/planes/planes_config.h"
#include "cabinet_articulation/stereo/depth_frame.h"

namespace cabinet_articulation::core {

/// The paper's plane sampling as it is written (III-B.1): sequential RANSAC over the points, with the distance d of
/// Eq. (1) in metres and samples from the whole image. The baseline of comparisons.
class MetricConsensus {
 public:
  explicit MetricConsensus(const PlanesConfig& config);

  /// The planes in the order they were found, at most `max_planes`. Seeded anew for every frame.
  std::vector<Plane> process(const DepthFrame& frame) const;

 private:
  PlanesConfig config_;
};

}  // namespace cabinet_articulation::core
