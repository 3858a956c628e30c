// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/ros/conversions.h"
#include "messages.h"
#include "model_uses.h"

using namespace cabinet_articulation;

fuzz::Seeds fuzz::seeds() {
  std::vector<std::string> requests;
  for (const core::Track& track : tracksOf(exampleFronts())) requests.push_back(serialized(toMessage(track, "map")));
  Track far = toMessage(exampleFronts()[0].track, "map"), large = far;
  far.poses[0].position.x = 1e154;
  large.widths[0] = 1e18;
  return {requests, {serialized(far), serialized(large)}};
}

/// A request to the service fit_track.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::examineMessages(data, size, [](fuzz::MessageReader& reader) {
    const auto message = reader.next<Track>();
    const core::Track track = wholeTrack(*message);
    fuzz::useModels(core::fitAllModels(track, {}), message->header.frame_id);
  });
}
