// SPDX-License-Identifier: BSD-3-Clause
#include <cabinet_articulation/KnownFrontArray.h>

#include "cabinet_articulation/pipeline/pipeline.h"
#include "cabinet_articulation/ros/conversions.h"
#include "messages.h"
#include "model_uses.h"
#include "small_frame.h"

using namespace cabinet_articulation;

namespace {

constexpr int kFrames = 4;

KnownFrontArray knownFronts() {
  KnownFrontArray known;
  known.header.frame_id = "map";
  known.generation = 7;
  known.next_id = 20;
  known.forgotten = {11, 12};
  for (const core::Track& track : fuzz::tracksOf(fuzz::exampleFronts())) known.tracks.push_back(toMessage(track, "map"));
  return known;
}

/// All fronts, coming nearer.
RectangleArray rectanglesOf(int frame) {
  std_msgs::Header header = test::exampleHeader();
  header.stamp += ros::Duration(0.066 * frame);
  std::vector<core::DetectedRectangle> rectangles = fuzz::seenAgain(fuzz::exampleFronts());
  for (core::DetectedRectangle& rectangle : rectangles) rectangle.rectangle.pose.translation().z() -= 0.01 * frame;
  return toMessage(rectangles, header);
}

}  // namespace

fuzz::Seeds fuzz::seeds() {
  std::string frames;
  for (int i = 0; i < kFrames; ++i) frames += serialized(rectanglesOf(i));
  RectangleArray late = rectanglesOf(1);
  late.header.stamp.sec = 4294967290U;
  return {{serialized(exampleTransform(), knownFronts()) + frames, serialized(exampleTransform(), KnownFrontArray()) + frames},
          {serialized(exampleTransform(), knownFronts(), rectanglesOf(0), late, rectanglesOf(2), rectanglesOf(3))}};
}

/// Fronts that are known, then some frames of rectangles, as the tracking stage gets them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::examineMessages(data, size, [](fuzz::MessageReader& reader) {
    core::RectangleTracker tracker{core::TrackingConfig()};
    core::TrackUpdates updates;
    const Eigen::Isometry3d T_fixed_camera = fuzz::throughTf(*reader.next<geometry_msgs::TransformStamped>());
    const auto known = reader.next<KnownFrontArray>();
    std::string left_out;
    std::vector<core::Track> fronts = usableTracks(*known, &left_out);
    tracker.useIdsFrom(known->next_id);
    for (const std::uint32_t id : known->forgotten) tracker.forget(id);
    tracker.remember(std::move(fronts));
    for (int i = 0; i < kFrames; ++i) {
      const auto message = reader.next<RectangleArray>();
      const double stamp = message->header.stamp.toSec();
      const auto& tracks = tracker.process(stamp, core::transformed(fromMessage(*message), T_fixed_camera));
      toMessage(updates.of(tracks, stamp), message->header);
      toMessage(tracker.expected(), message->header);
    }
    toMessage(tracker.knownTracks(), known->header);
  });
}
