// SPDX-License-Identifier: BSD-3-Clause
#include "structure/seen_motion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cabinet_articulation::core {

void SeenMotion::follow(const Track& track, double step) {
  auto first = track.observations.end();
  while (first != track.observations.begin() && (!place_ || (first - 1)->stamp > stamp_)) --first;
  for (auto seen = first; seen != track.observations.end(); ++seen) {
    const Rectangle& rectangle = seen->rectangle;
    if (!rectangle.pose.matrix().allFinite() || !std::isfinite(seen->stamp)) continue;
    ++observations_;
    stamp_ = seen->stamp;
    const double way = place_ ? distanceOfCorners(rectangle, *place_) : 0;
    if (place_ && way < step) continue;
    place_ = rectangle;
    way_ += way;
  }
}

double distanceOfCorners(const Rectangle& a, const Rectangle& b) {
  const auto corners = a.corners(), others = b.corners();
  double distance = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) distance = std::max(distance, (corners[i] - others[i]).norm());
  return distance;
}

}  // namespace cabinet_articulation::core
