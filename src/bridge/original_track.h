// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <articulation_msgs/TrackMsg.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::bridge {

/// A track of the original release. Where it has channels `width` and `height`, its poses are those of a rectangle's corner, from
/// which x runs along the width and y along the height; else they are those of a marker.
struct OriginalTrack {
  core::Track track;  ///< of the rectangle's centre, or of the marker; stamps count the poses where the message has none
  Eigen::Isometry3d T_pose_center = Eigen::Isometry3d::Identity();  ///< for the mean size
};

/// Throws std::invalid_argument that names the element: no poses, more than limits::kMostEntries, lists whose lengths differ, and
/// what limits.h refuses.
OriginalTrack fromOriginal(const articulation_msgs::TrackMsg& message);

/// With the corner's poses, the channels `width` and `height`, and the stamps. Of a marker, whose size is 0, without channels.
articulation_msgs::TrackMsg toOriginal(const core::Track& track, const std::string& frame_id);

/// The values of a channel, one for each pose; made if it is not there.
std::vector<float>& channel(const std::string& name, articulation_msgs::TrackMsg* track);

}  // namespace cabinet_articulation::bridge
