// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/rectangles/detected_rectangle.h"
#include "cabinet_articulation/tracking/tracking_config.h"
#include "tracking/size/length_estimate.h"
#include "tracking/size/placement.h"

namespace cabinet_articulation::core {

/// Width and height of one front, estimated over its whole track. All detections in the track's corner choice.
class FrontSize {
 public:
  explicit FrontSize(const TrackingConfig& config) : config_(config) {}

  /// Lengths count by the certainty of their two edges (edgeSigma).
  void add(const DetectedRectangle& detection);

  /// Could this detection be the front, by its size? Within size_tolerance and what is uncertain about the estimate
  /// ("considered also the uncertainty in the estimate of the object size", paper III-C) and about the detection's edges
  /// (cut, hidden, or merged with a neighbour), but no less than a third and no more than twice as long.
  bool fits(const DetectedRectangle& detection) const;

  /// The estimate; a length that was never observed is as uncertain as the size of fronts is.
  const KnownSize& known() const { return known_; }

 private:
  TrackingConfig config_;
  LengthEstimate lengths_[2];
  double hardly_seen_[2] = {0, 0};  ///< sum of the weights of lengths that count little
  KnownSize known_{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
};

}  // namespace cabinet_articulation::core
