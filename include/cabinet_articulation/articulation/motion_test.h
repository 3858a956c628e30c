// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/articulation/articulation_model.h"
#include "cabinet_articulation/articulation/pose_track.h"
#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/**
 * Whether a front moved (ours). Pieces of furniture that are hardly visible jitter by centimetres and tens of degrees while
 * they stand still. Some point of the front must have come farther than motion_min, than motion_to_jitter times its jitter
 * from one frame to the next, and than motion_to_noise times its distance from where the model says. It must have been seen in
 * between, too. There is no motion while the median observation has less than edge_support_min of its edges, or there are fewer
 * than observations_min.
 */
class MotionTest {
 public:
  /// `poses` are those of `track`'s front, in the order of their stamps.
  MotionTest(const Track& track, const PoseTrack& poses, const ArticulationConfig& config);

  /// From now on nothing passes.
  void refuse() { refused_ = true; }

  /// `residuals` are those of `poses`, which may be thinned out.
  bool passes(const ArticulationModel& model, const ModelResiduals& residuals, const PoseTrack& poses) const;

  /// [m] Standard deviation of the points of the outline from one frame to the next, in each direction.
  const std::vector<double>& jitter() const { return jitter_; }

 private:
  ArticulationConfig config_;
  bool refused_;
  std::vector<double> jitter_;
};

}  // namespace cabinet_articulation::core
