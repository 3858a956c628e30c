// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/continuation.h"

#include "cabinet_articulation/tracking/history.h"
#include "cabinet_articulation/tracking/motion_gate.h"
#include "cabinet_articulation/tracking/placement.h"

namespace cabinet_articulation::core {
namespace {

std::optional<Continuation> continueFrom(const Rectangle& reference, double seconds, const DetectedRectangle& detection,
                                         const FrontSize& size, const TrackingConfig& config) {
  const DetectedRectangle aligned = alignDescription(detection, reference);
  if (!size.fits(aligned, config)) return std::nullopt;
  const Rectangle placed =
      placeOnObservedEdges(aligned, {reference.width, reference.height}, &reference, config.min_edge_support).rectangle;
  if (!isPossibleMotion(reference, placed, seconds, config)) return std::nullopt;
  return Continuation{cornerDistance(reference, placed), aligned, reference};
}

}  // namespace

std::optional<Continuation> findContinuation(const Track& track, const FrontSize& size, const DetectedRectangle& detection,
                                             double stamp, const TrackingConfig& config) {
  std::optional<Continuation> best;
  const auto consider = [&](const Rectangle& reference, double seconds) {
    const auto candidate = continueFrom(reference, seconds, detection, size, config);
    if (candidate && (!best || candidate->distance < best->distance)) best = candidate;
  };
  const double gap = stamp - track.observations.back().stamp;
  consider(track.observations.back().rectangle, gap);
  consider(extrapolate(track.observations, stamp, config.prediction_horizon), 0);
  if (gap > config.prediction_horizon)
    consider(nearestObservation(track.observations, detection.rectangle.center()).rectangle, 0);
  return best;
}

}  // namespace cabinet_articulation::core
