// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracker/track_growth.h"

#include <algorithm>

#include "tracking/matching/continuation.h"
#include "tracking/motion/history.h"
#include "tracking/size/placement.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kLongestFlicker = 3;     ///< frames; a longer absence is one absence, not so many misses
constexpr double kResizeStep = 0.002;  ///< [m] smaller changes of the size are not worth placing the history anew

/// All observations with the track's new size, from the newest back: the size was known worst at the beginning. The newest
/// continues from `reference`.
void placeAnew(Track& track, const KnownSize& size, const KnownPlace& reference, const TrackingConfig& config) {
  KnownPlace later = reference;
  for (auto observation = track.observations.rbegin(); observation != track.observations.rend(); ++observation) {
    DetectedRectangle detection;
    detection.rectangle = observation->measured;
    detection.covariance = observation->measured_covariance;
    detection.edge_support = observation->edge_support;
    const DetectedRectangle placed = placeOnObservedEdges(detection, size, &later, config);
    observation->rectangle = placed.rectangle;
    observation->covariance = placed.covariance;
    later = {placed.rectangle, placed.covariance.topLeftCorner<3, 3>()};
  }
}

}  // namespace

Track startOfTrack(double stamp, const DetectedRectangle& detection) {
  Track track;
  track.width = detection.rectangle.width;
  track.height = detection.rectangle.height;
  track.hollow = detection.hollow;
  track.observations.push_back(
      {stamp, detection.rectangle, detection.covariance, detection.edge_support, detection.rectangle, detection.covariance});
  return track;
}

void append(double stamp, const DetectedRectangle& rectangle, const TrackingConfig& config, Track* grown,
            TrackMemory* remembered) {
  Track& track = *grown;
  TrackMemory& memory = *remembered;
  const Continuation found = *findContinuation(track, memory, rectangle, stamp, config);
  const DetectedRectangle& measured = found.measured;
  memory.frames += std::min(memory.unseen, kLongestFlicker);
  memory.unseen = 0;
  memory.last_seen = stamp;
  ++memory.seen;
  track.hollow = track.hollow || rectangle.hollow;
  memory.size.add(measured);
  const KnownSize& known = memory.size.known();
  const bool resized = (known.value - Eigen::Vector2d(track.width, track.height)).cwiseAbs().maxCoeff() > kResizeStep ||
                       (known.sigma.array() < memory.placed_sigma.array() / 2).any();
  if (resized) {
    track.width = known.value.x();
    track.height = known.value.y();
    memory.placed_sigma = known.sigma;
  }
  const DetectedRectangle placed = placeOnObservedEdges(measured, known, &found.reference, config);
  track.observations.push_back(
      {stamp, placed.rectangle, placed.covariance, measured.edge_support, measured.rectangle, measured.covariance});
  if (resized) placeAnew(track, known, found.reference, config);
  if (resized) ++track.revision;
  thinOut(track.observations, config.max_observations);
}

}  // namespace cabinet_articulation::core
