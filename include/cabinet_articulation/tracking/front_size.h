// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/rectangles/detected_rectangle.h"
#include "cabinet_articulation/tracking/length_estimate.h"
#include "cabinet_articulation/tracking/placement.h"
#include "cabinet_articulation/tracking/tracking_config.h"

namespace cabinet_articulation::core {

/// Width and height of one front, estimated over its whole track. All detections in the track's corner choice.
class FrontSize {
 public:
  /// Lengths count by the product of the observed shares of their two edges.
  void add(const DetectedRectangle& detection);

  /// Could this detection be the front, by its size? The tolerance shrinks while the estimate grows certain ("considered
  /// also the uncertainty in the estimate of the object size", paper III-C). An axis with an unobserved edge (cut,
  /// hidden, or merged with a neighbour) may have from a third to twice the length.
  bool fits(const DetectedRectangle& detection, const TrackingConfig& config) const;

  /// The estimate; a length that was never observed is as uncertain as the size of fronts is.
  KnownSize known(const TrackingConfig& config) const;

 private:
  LengthEstimate lengths_[2];
};

}  // namespace cabinet_articulation::core
