// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "cabinet_articulation/rectangles/detected_rectangle.h"
#include "cabinet_articulation/tracking/length_estimate.h"
#include "cabinet_articulation/tracking/tracking_config.h"

namespace cabinet_articulation::core {

/// Width and height of one front, estimated over its whole track. All detections in the track's corner choice.
class FrontSize {
 public:
  /// Lengths count by the product of the observed shares of their two edges.
  void add(const DetectedRectangle& detection, const TrackingConfig& config);

  /// Could this detection be the front, by its size? The tolerance shrinks while the estimate grows certain ("considered
  /// also the uncertainty in the estimate of the object size", paper III-C). An axis with an unobserved edge (cut,
  /// hidden, or merged with a neighbour) may have any length from a third of the front's to its double.
  bool fits(const DetectedRectangle& detection, const TrackingConfig& config) const;

  /// Width and height [m].
  Eigen::Vector2d value() const { return {lengths_[0].median(), lengths_[1].median()}; }

 private:
  LengthEstimate lengths_[2];
};

}  // namespace cabinet_articulation::core
