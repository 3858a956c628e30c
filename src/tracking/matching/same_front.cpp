// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/matching/same_front.h"

#include <algorithm>
#include <cmath>

#include "cabinet_articulation/tracking/expected_fronts.h"
#include "geometry/board.h"
#include "tracking/matching/track_memory.h"

namespace cabinet_articulation::core {
namespace {

/// [m2] of two rectangles with this intersection over union.
double sharedArea(double overlap, const Rectangle& a, const Rectangle& b) {
  return overlap / (1 + overlap) * (a.width * a.height + b.width * b.height);
}

/// What looks the other way may be the back of the same board.
bool areInOnePlane(const Rectangle& a, const Rectangle& b, double distance, double cosine) {
  const double facing = a.normal().dot(b.normal()), off = a.plane().distance(b.center());
  const double back = facing < 0 ? -kBoard : 0;
  return std::abs(facing) > cosine && std::min(std::abs(off), std::abs(off - back)) < distance;
}

}  // namespace

bool isDuplicate(const Rectangle& a, const Rectangle& b) {
  constexpr double kOverlap = 0.3, kDistance = 0.02, kCosine = 0.995;  // -, m, 6 degrees
  return areInOnePlane(a, b, kDistance, kCosine) && intersectionOverUnion(a, b) > kOverlap;
}

double overlapInOnePlace(const Rectangle& a, const Rectangle& b, const TrackingConfig& config) {
  if (!areInOnePlane(a, b, config.position_tolerance, std::cos(config.angle_tolerance))) return 0;
  const double overlap = intersectionOverUnion(a, b);
  return 2 * sharedArea(overlap, a, b) > std::min(a.width * a.height, b.width * b.height) ? overlap : 0;
}

bool isPartOf(const Track& track, const Rectangle& part, double stamp, const TrackingConfig& config) {
  constexpr double kRecent = 0.3, kMoved = 0.03, kInside = 0.7, kDistance = 0.02, kCosine = 0.99;  // s, m, -, m, 8 degrees
  const TrackedObservation& newest = track.observations.back();
  const Eigen::Vector3d way = newest.rectangle.center() - track.observations.front().rectangle.center();
  if (!isConfirmed(track, config) || stamp - newest.stamp > kRecent || way.norm() < kMoved) return false;
  const Rectangle front =
      newest.stamp == stamp ? newest.rectangle : newestMotion(track.observations).at(stamp, config.prediction_horizon);
  return areInOnePlane(front, part, kDistance, kCosine) &&
         sharedArea(intersectionOverUnion(front, part), front, part) > kInside * part.width * part.height;
}

}  // namespace cabinet_articulation::core
