// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <articulation_msgs/TrackMsg.h>

#include <random>

#include "bridge/original_params.h"
#include "cabinet_articulation/ros/pose_conversions.h"

namespace cabinet_articulation::bridge {

constexpr int kPoses = 40;
const Eigen::Isometry3d kDoor(Eigen::Translation3d(0.4, 0.1, 1.5) * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()));

/// The original's forward map of a rotational model.
inline Eigen::Isometry3d originalTurn(const Params& params, double q) {
  return Eigen::Translation3d(requireVector(params, "rot_center")) * requireQuaternion(params, "rot_axis") *
         Eigen::AngleAxisd(-q, Eigen::Vector3d::UnitZ()) * Eigen::Translation3d(requireParam(params, "rot_radius"), 0, 0) *
         Eigen::Isometry3d(requireQuaternion(params, "rot_orientation"));
}

/// A pose that turns about a vertical axis through the origin, or slides along z.
inline Eigen::Isometry3d turned(double q) { return Eigen::AngleAxisd(q, Eigen::Vector3d::UnitY()) * kDoor; }
inline Eigen::Isometry3d pulled(double q) { return Eigen::Translation3d(0, 0, -q) * kDoor; }

template <class PoseAt>
articulation_msgs::TrackMsg trackOf(const PoseAt& poseAt, double range, double noise = 0.001) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, noise);
  articulation_msgs::TrackMsg track;
  track.header.frame_id = "map";
  for (int i = 0; i < kPoses; ++i) {
    Eigen::Isometry3d pose = poseAt(range * i / (kPoses - 1));
    pose.pretranslate(Eigen::Vector3d(normal(random), normal(random), normal(random)));
    track.pose.push_back(toMessage(pose));
  }
  return track;
}

}  // namespace cabinet_articulation::bridge
