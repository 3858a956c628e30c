// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/rectangles/detected_rectangle.h"
#include "cabinet_articulation/tracking/expected_fronts.h"
#include "cabinet_articulation/tracking/track_updates.h"

namespace cabinet_articulation::core {

/*
 * What goes from stage to stage, as it arrives in the nodelets' messages: the same to the bit, which a test of the messages
 * proves, for times that came from messages. See geometry/message_precision.h.
 */

std::vector<DetectedRectangle> asSent(std::vector<DetectedRectangle> rectangles);
ExpectedFronts asSent(ExpectedFronts expected);
Track asSent(Track track);
std::vector<TrackUpdate> asSent(std::vector<TrackUpdate> updates);

}  // namespace cabinet_articulation::core
