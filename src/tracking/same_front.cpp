// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/same_front.h"

#include <cmath>

#include "cabinet_articulation/tracking/expected_fronts.h"
#include "tracking/track_memory.h"

namespace cabinet_articulation::core {

bool isDuplicate(const Rectangle& a, const Rectangle& b) {
  constexpr double kOverlap = 0.3, kDistance = 0.02, kCosine = 0.995;  // -, m, 6 degrees
  return std::abs(a.normal().dot(b.normal())) > kCosine && std::abs(a.plane().distance(b.center())) < kDistance &&
         intersectionOverUnion(a, b) > kOverlap;
}

bool isPartOf(const Track& track, const Rectangle& part, double stamp, const TrackingConfig& config) {
  constexpr double kRecent = 0.3, kMoved = 0.03, kInside = 0.7, kDistance = 0.02, kCosine = 0.99;  // s, m, -, m, 8 degrees
  const TrackedObservation& newest = track.observations.back();
  const Eigen::Vector3d way = newest.rectangle.center() - track.observations.front().rectangle.center();
  if (!isConfirmed(track, config) || stamp - newest.stamp > kRecent || way.norm() < kMoved) return false;
  const Rectangle front =
      newest.stamp == stamp ? newest.rectangle : newestMotion(track.observations).at(stamp, config.prediction_horizon);
  if (std::abs(front.normal().dot(part.normal())) < kCosine || std::abs(front.plane().distance(part.center())) > kDistance)
    return false;
  const double area = part.width * part.height, overlap = intersectionOverUnion(front, part);
  return overlap / (1 + overlap) * (front.width * front.height + area) > kInside * area;
}

}  // namespace cabinet_articulation::core
