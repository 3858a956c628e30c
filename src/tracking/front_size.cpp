// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/front_size.h"

#include <algorithm>
#include <cmath>

namespace cabinet_articulation::core {
namespace {

/// Share of an axis that was observed: the product of its edges', or nothing if one of them was not.
double axisSupport(const DetectedRectangle& detection, int axis, double min_support) {
  const double minus = detection.edge_support[2 * axis];
  const double plus = detection.edge_support[2 * axis + 1];
  return minus >= min_support && plus >= min_support ? minus * plus : 0;
}

double measuredLength(const DetectedRectangle& detection, int axis) {
  return axis == 0 ? detection.rectangle.width : detection.rectangle.height;
}

/// Two sigmas of the estimate beside the fixed tolerance; the first lengths are trusted little.
double tolerance(const LengthEstimate& length, const TrackingConfig& config) {
  const double prior = config.first_size_sigma * config.first_size_sigma;
  const double weight = length.weight();
  const double variance = (prior + weight * length.spread() * length.spread()) / (1 + weight);
  return config.size_tolerance + 2 * std::sqrt(variance / (1 + weight));
}

}  // namespace

void FrontSize::add(const DetectedRectangle& detection, const TrackingConfig& config) {
  for (int axis = 0; axis < 2; ++axis)
    lengths_[axis].add(measuredLength(detection, axis), axisSupport(detection, axis, config.min_edge_support));
}

bool FrontSize::fits(const DetectedRectangle& detection, const TrackingConfig& config) const {
  for (int axis = 0; axis < 2; ++axis) {
    const double measured = measuredLength(detection, axis);
    const double known = lengths_[axis].median();
    const bool observed = axisSupport(detection, axis, config.min_edge_support) > 0;
    if (observed && std::abs(measured - known) > std::min(tolerance(lengths_[axis], config), known / 2)) return false;
    if (!observed && (measured < known / 3 || measured > known * 2)) return false;
  }
  return true;
}

}  // namespace cabinet_articulation::core
