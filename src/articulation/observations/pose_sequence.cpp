// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/observations/pose_sequence.h"

namespace cabinet_articulation::core {

PoseSequence selected(const PoseSequence& track, const std::vector<std::size_t>& indices) {
  PoseSequence out;
  out.has_orientation = track.has_orientation;
  out.outline = track.outline;
  out.hinge = track.hinge;
  out.is_marker = track.is_marker;
  out.position_jitter = track.position_jitter;
  out.orientation_jitter = track.orientation_jitter;
  const auto pick = [&indices](const auto& from, auto* to) {
    to->reserve(indices.size());
    for (std::size_t i : indices)
      if (i < from.size()) to->push_back(from[i]);
  };
  pick(track.stamps, &out.stamps);
  pick(track.poses, &out.poses);
  pick(track.position_weights, &out.position_weights);
  pick(track.orientation_weights, &out.orientation_weights);
  pick(track.edge_support, &out.edge_support);
  pick(track.run_starts, &out.run_starts);
  return out;
}

PoseSamples::PoseSamples(const PoseSequence& track)
    : has_orientation(track.has_orientation),
      hinge(track.hinge),
      position_jitter(track.position_jitter),
      orientation_jitter(track.orientation_jitter),
      is_marker(track.is_marker) {
  positions.reserve(track.size());
  orientations.reserve(track.size());
  for (const Eigen::Isometry3d& pose : track.poses) {
    positions.push_back(pose.translation());
    orientations.emplace_back(pose.linear());
  }
  for (std::size_t i = 0; i < track.size(); ++i) run_starts.push_back(track.startsRun(i));
  if (has_orientation) {
    position_weights = track.position_weights;
    orientation_weights = track.orientation_weights;
  }
}

}  // namespace cabinet_articulation::core
