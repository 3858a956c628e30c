// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/pipeline/as_sent.h"

#include "cabinet_articulation/geometry/unit_quaternion.h"

namespace cabinet_articulation::core {

std::vector<DetectedRectangle> asSent(std::vector<DetectedRectangle> rectangles) {
  for (DetectedRectangle& detected : rectangles) detected.rectangle.pose = asSent(detected.rectangle.pose);
  return rectangles;
}

ExpectedFronts asSent(ExpectedFronts expected) {
  for (ExpectedFront& front : expected.fronts) front.rectangle.pose = asSent(front.rectangle.pose);
  return expected;
}

std::vector<TrackUpdate> asSent(std::vector<TrackUpdate> updates) {
  for (TrackUpdate& update : updates)
    for (TrackedObservation& observation : update.track.observations) {
      observation.rectangle.pose = asSent(observation.rectangle.pose);
      observation.measured.pose = asSent(observation.measured.pose);
    }
  return updates;
}

}  // namespace cabinet_articulation::core
