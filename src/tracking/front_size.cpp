// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/front_size.h"

#include <algorithm>
#include <cmath>

namespace cabinet_articulation::core {
namespace {

constexpr double kAnyFront = 0.3;  ///< [m] sigma of the size of a front nobody has seen

/// Share of an axis that was observed.
double axisSupport(const DetectedRectangle& detection, int axis) {
  return static_cast<double>(detection.edge_support[2 * axis]) * detection.edge_support[2 * axis + 1];
}

bool bothEdgesObserved(const DetectedRectangle& detection, int axis, double min_support) {
  return std::min(detection.edge_support[2 * axis], detection.edge_support[2 * axis + 1]) >= min_support;
}

double measuredLength(const DetectedRectangle& detection, int axis) {
  return axis == 0 ? detection.rectangle.width : detection.rectangle.height;
}

/// What any front is like, and the median of as many lengths as were observed; the first ones are trusted little.
double sigma(const LengthEstimate& length, const TrackingConfig& config) {
  const double prior = config.first_size_sigma * config.first_size_sigma;
  const double weight = length.weight();
  const double variance = (prior + weight * length.spread() * length.spread()) / (1 + weight);  // of one length
  return 1 / std::sqrt(1 / (kAnyFront * kAnyFront) + weight / variance);
}

}  // namespace

void FrontSize::add(const DetectedRectangle& detection) {
  for (int axis = 0; axis < 2; ++axis) lengths_[axis].add(measuredLength(detection, axis), axisSupport(detection, axis));
}

bool FrontSize::fits(const DetectedRectangle& detection, const TrackingConfig& config) const {
  for (int axis = 0; axis < 2; ++axis) {
    const double measured = measuredLength(detection, axis);
    const double known = lengths_[axis].median();
    const bool observed = bothEdgesObserved(detection, axis, config.min_edge_support);
    const double tolerance = config.size_tolerance + 2 * sigma(lengths_[axis], config);
    if (observed && std::abs(measured - known) > std::min(tolerance, known / 2)) return false;
    if (!observed && (measured < known / 3 || measured > known * 2)) return false;
  }
  return true;
}

KnownSize FrontSize::known(const TrackingConfig& config) const {
  return {{lengths_[0].median(), lengths_[1].median()}, {sigma(lengths_[0], config), sigma(lengths_[1], config)}};
}

}  // namespace cabinet_articulation::core
