// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/matching/continuation.h"

#include <cmath>

#include "cabinet_articulation/tracking/expected_fronts.h"
#include "geometry/board.h"
#include "tracking/motion/history.h"
#include "tracking/motion/motion_gate.h"
#include "tracking/size/placement.h"

namespace cabinet_articulation::core {
namespace {

KnownPlace placeOf(const TrackedObservation& observation) {
  return {observation.rectangle, observation.covariance.topLeftCorner<3, 3>()};
}

/// The side that is not seen. A track is of that side of a front which it saw first.
DetectedRectangle otherSide(DetectedRectangle detection) {
  const Eigen::Vector3d normal = detection.rectangle.normal();
  detection.rectangle.pose.translation() -= kBoard * normal;
  const Eigen::Vector3d sigma = kBoard / 2 * normal;
  detection.covariance.topLeftCorner(sigma.size(), sigma.size()) += sigma * sigma.transpose();
  return detection;
}

/// In that description of the detection that needs the least motion. Nearest axes alone do not tell: a door swung by more
/// than 90 degrees has the axes of its own back.
std::optional<Continuation> continueFrom(const KnownPlace& reference, double seconds, const DetectedRectangle& detection,
                                         const FrontSize& size, const TrackingConfig& config) {
  std::optional<Continuation> best;
  if ((reference.rectangle.center() - detection.rectangle.center()).norm() > reach(reference.rectangle, seconds, config))
    return best;
  const DetectedRectangle behind = otherSide(detection);
  for (int k = 0; k < kDescriptions; ++k) {
    const DetectedRectangle described = describe(k < kDescriptions / 2 ? detection : behind, k);
    if (!size.fits(described)) continue;
    const Rectangle placed = placeRectangle(described, size.known(), &reference, config);
    const std::optional<double> distance = motionDistance(reference.rectangle, placed, seconds, config);
    if (distance && (!best || *distance < best->distance)) best = Continuation{*distance, described, reference};
  }
  return best;
}

}  // namespace

std::optional<Continuation> findContinuation(const Track& track, const TrackMemory& memory, const DetectedRectangle& detection,
                                             double stamp, const TrackingConfig& config) {
  // Behind a front that opens there may be the body's own frame.
  if (detection.hollow && !track.hollow && isConfirmed(track, config)) return std::nullopt;
  std::optional<Continuation> best;
  const auto consider = [&](const KnownPlace& reference, double seconds) {
    const auto candidate = continueFrom(reference, seconds, detection, memory.size, config);
    if (candidate && (!best || candidate->distance < best->distance)) best = candidate;
  };
  const double gap = stamp - memory.last_seen;
  const double now = std::isfinite(gap) ? stamp : gap;  // the time of the history may be another one then
  const KnownPlace newest = placeOf(track.observations.back());
  consider(newest, gap);
  consider({newestMotion(track.observations).at(now, config.prediction_horizon), newest.covariance}, 0);
  if (gap > config.prediction_horizon) consider(placeOf(nearestObservation(track.observations, detection.rectangle.center())), 0);
  return best;
}

}  // namespace cabinet_articulation::core
