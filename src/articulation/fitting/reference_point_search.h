// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "articulation/observations/observation_history.h"
#include "articulation/paths/arc.h"

namespace cabinet_articulation::core {

/// Looks for the point of a front whose positions have the least noise about a circle, as a share of their way (ours). A point
/// far from the hinge is seen better than the centre, half of whose error comes from the edge at the hinge. The centre is taken
/// where the size hardly varies, once the front was seen more than a few times. One point at a time, so that a track that goes on
/// need not wait.
class ReferencePointSearch {
 public:
  explicit ReferencePointSearch(const ArticulationConfig& config) : config_(config) {}

  /// Looks at all points of a front of the given size, or at one more in each call. True when none is left.
  bool advance(const ObservationHistory& poses, double width, double height, bool all);

  /// The best point. `preferred` (may be null) is kept unless another is clearly better.
  ReferencePoint best(const ReferencePoint* preferred) const;

 private:
  bool isSteady(const ObservationHistory& poses, double width, double height) const;
  void lookAt(const ReferencePoint& point, const ObservationHistory& poses, double width, double height);

  struct Option {
    ReferencePoint point;
    double noise;
  };

  ArticulationConfig config_;
  std::vector<Option> options_;
  Arc center_arc_;
};

}  // namespace cabinet_articulation::core
