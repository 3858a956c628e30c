// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/size/front_size.h"

#include <algorithm>
#include <cmath>

namespace cabinet_articulation::core {
namespace {

constexpr double kAnyFront = 0.3;       ///< [m] sigma of the size of a front nobody has seen
constexpr double kHardlySeen = 0.01;    ///< weight of a length, the best being 1
constexpr double kHardlySeenSum = 1.0;  ///< hours of a half hidden front must not outweigh a minute of a visible one

/// Of the distance between the two edges of an axis [m].
double lengthSigma(const DetectedRectangle& detection, int axis, const TrackingConfig& config) {
  return Eigen::Vector2d(edgeSigma(detection.edge_support[2 * axis], config),
                         edgeSigma(detection.edge_support[2 * axis + 1], config))
      .norm();
}

double bestSigma(const TrackingConfig& config) { return std::sqrt(2) * config.edge_sigma; }

double measuredLength(const DetectedRectangle& detection, int axis) {
  return axis == 0 ? detection.rectangle.width : detection.rectangle.height;
}

/// What any front is like, and the best observed length: edges err together over a track, so many frames say no more than
/// one. But the first ones may all be wrong.
double sigma(const LengthEstimate& length, const TrackingConfig& config) {
  const double observed = std::pow(bestSigma(config), 2) / std::max(length.bestWeight(), 1e-6);
  const double count = std::max(length.count(), 1.0);
  const double first = std::pow(config.first_size_sigma / count, 2);
  const double spread = std::pow(length.spread(), 2) / count;
  return 1 / std::sqrt(1 / (kAnyFront * kAnyFront) + 1 / (observed + first + spread));
}

}  // namespace

void FrontSize::add(const DetectedRectangle& detection) {
  for (int axis = 0; axis < 2; ++axis) {
    double weight = std::pow(bestSigma(config_) / lengthSigma(detection, axis, config_), 2);
    if (weight < kHardlySeen) {
      weight = std::min(weight, kHardlySeenSum - hardly_seen_[axis]);
      hardly_seen_[axis] += weight;
    }
    lengths_[axis].add(measuredLength(detection, axis), weight);
    known_.value[axis] = lengths_[axis].median();
    known_.sigma[axis] = sigma(lengths_[axis], config_);
  }
}

bool FrontSize::fits(const DetectedRectangle& detection) const {
  for (int axis = 0; axis < 2; ++axis) {
    const double measured = measuredLength(detection, axis);
    const double known = known_.value[axis];
    const double tolerance =
        config_.size_tolerance + 2 * Eigen::Vector2d(known_.sigma[axis], lengthSigma(detection, axis, config_)).norm();
    if (std::abs(measured - known) > tolerance || measured < known / 3 || measured > known * 2) return false;
  }
  return true;
}

}  // namespace cabinet_articulation::core
