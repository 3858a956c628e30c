// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/structure/structure_finder.h"
#include "closing/closed_finder.h"
#include "kinds/kind_memory.h"
#include "messages.h"
#include "model_uses.h"
#include "ros/messages/kind_messages.h"
#include "support/ros_messages.h"

using namespace cabinet_articulation;

fuzz::Seeds fuzz::seeds() {
  const std::vector<core::Track> tracks = tracksOf(exampleFronts());
  std::vector<core::TrackUpdate> whole, ends;
  for (const core::Track& track : tracks) {
    const auto& all = track.observations;
    whole.push_back({track, 0});
    whole.back().track.observations.pop_back();
    ends.push_back({track, all.size() - 2});
    ends.back().track.observations.assign(all.end() - 2, all.end());
  }
  core::DepthView view;
  view.columns = view.rows = 8;
  view.fx = view.fy = 6;
  view.cx = view.cy = 3.5;
  view.depth.assign(64, 1.3F);
  std_msgs::Header header = test::exampleHeader(), late = header;
  late.stamp.sec = 4294967290U;
  TrackArray seen = toMessage(tracks, header);
  seen.view = toMessage(view);
  return {{serialized(seen, seen), serialized(toMessage(whole, header), toMessage(ends, header)),
           serialized(toMessage(tracks, header))},
          {serialized(toMessage(tracks, late)), serialized(toMessage(tracks, header), toMessage(tracks, late))}};
}

/// Tracks as the articulation stage gets them: whole ones, and what is new.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::examineMessages(data, size, [](fuzz::MessageReader& reader) {
    core::ArticulationLearner learner{core::ArticulationConfig()};
    core::ClosedFinder closed;
    core::StructureFinder structure{core::ArticulationConfig()};
    core::KindMemory kinds{core::LearningConfig()};
    core::KnownFronts known;
    std::string frame;
    do {
      const auto message = reader.next<TrackArray>();
      frame = message->header.frame_id;
      known.follow(fromMessage(*message));
      core::DepthView view = fromMessage(message->view);
      view.stamp = message->header.stamp.toSec();
      closed.see(std::move(view));
      std::vector<core::LearnedModel> models = learner.process(known.tracks());
      closed.complete(&models);
      structure.complete(known.tracks(), &models);
      known.update(models);
      kinds.complete(known.tracks(), &models);
      fuzz::useModels(models, frame);
    } while (!reader.atEnd());
    toMessages(kinds.kinds());
    fuzz::saveAndLoad(known.joints(), frame, kinds.votesBeside({}));
  });
}
