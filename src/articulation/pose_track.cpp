// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/pose_track.h"

#include <numeric>

namespace cabinet_articulation::core {
namespace {

PoseTrack selected(const PoseTrack& track, const std::vector<std::size_t>& indices) {
  PoseTrack out;
  out.has_orientation = track.has_orientation;
  out.outline = track.outline;
  const auto pick = [&indices](const auto& from, auto* to) {
    to->reserve(indices.size());
    for (std::size_t i : indices)
      if (i < from.size()) to->push_back(from[i]);
  };
  pick(track.stamps, &out.stamps);
  pick(track.poses, &out.poses);
  pick(track.position_weights, &out.position_weights);
  pick(track.orientation_weights, &out.orientation_weights);
  return out;
}

}  // namespace

PoseTrack thinned(const PoseTrack& track, std::size_t count) {
  if (track.size() <= count || count < 2) return track;
  std::vector<std::size_t> indices(count);
  for (std::size_t i = 0; i < count; ++i) indices[i] = i * (track.size() - 1) / (count - 1);
  return selected(track, indices);
}

PoseTrack tail(const PoseTrack& track, std::size_t first) {
  if (first == 0) return track;
  std::vector<std::size_t> indices(track.size() - first);
  std::iota(indices.begin(), indices.end(), first);
  return selected(track, indices);
}

PoseSamples::PoseSamples(const PoseTrack& track) : has_orientation(track.has_orientation) {
  positions.reserve(track.size());
  orientations.reserve(track.size());
  for (const Eigen::Isometry3d& pose : track.poses) {
    positions.push_back(pose.translation());
    orientations.emplace_back(pose.linear());
  }
  if (has_orientation) {
    position_weights = track.position_weights;
    orientation_weights = track.orientation_weights;
  }
}

}  // namespace cabinet_articulation::core
