// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/// How much was seen of a front, whatever its track still holds of it: long tracks are thinned out.
class SeenMotion {
 public:
  /// The track as it is now. A way counts in steps of at least `step` [m], so that noise is none.
  void follow(const Track& track, double step);

  double observations() const { return observations_; }

  /// [m] of the corner that went farthest in each step.
  double way() const { return way_; }

 private:
  double observations_ = 0, way_ = 0;
  double stamp_ = 0;                ///< [s] of what counts already
  std::optional<Rectangle> place_;  ///< where the last step ended
};

/// [m] The largest distance between corners of one name.
double distanceOfCorners(const Rectangle& a, const Rectangle& b);

}  // namespace cabinet_articulation::core
