// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/as_sent.h"

#include <utility>

#include "geometry/message_precision.h"

namespace cabinet_articulation::core {

std::vector<DetectedRectangle> asSent(std::vector<DetectedRectangle> rectangles) {
  for (DetectedRectangle& detected : rectangles) detected.rectangle.pose = asSent(detected.rectangle.pose);
  return rectangles;
}

ExpectedFronts asSent(ExpectedFronts expected) {
  for (ExpectedFront& front : expected.fronts) front.rectangle.pose = asSent(front.rectangle.pose);
  return expected;
}

Track asSent(Track track) {
  for (TrackedObservation& observation : track.observations) {
    observation.rectangle.pose = asSent(observation.rectangle.pose);
    observation.measured.pose = asSent(observation.measured.pose);
  }
  return track;
}

std::vector<TrackUpdate> asSent(std::vector<TrackUpdate> updates) {
  for (TrackUpdate& update : updates) update.track = asSent(std::move(update.track));
  return updates;
}

}  // namespace cabinet_articulation::core
