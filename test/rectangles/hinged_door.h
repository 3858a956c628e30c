// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "front_scene.h"

namespace cabinet_articulation::core {

/// A door that turns about a hinge 11 mm inside its edge and face, beside a front 3 mm from it when closed. The camera looks
/// from the hinge's side, by 35 degrees, and sees the outer face of the door however far it opens.
struct HingedDoor {
  explicit HingedDoor(double angle) : neighbour(exampleFront({-kGap - 0.15, 0, 0}, 0.3, 0.3, 0, 0, 0)), door(neighbour) {
    const Eigen::Vector3d axis(kInset, 0, kInset);
    const Eigen::AngleAxisd turn(angle, Eigen::Vector3d::UnitY());
    door.pose.translation() = axis + turn * (Eigen::Vector3d(door.width / 2, 0, 0) - axis);
    door.pose.linear() = turn * door.pose.linear();
    Eigen::Isometry3d T_camera_cabinet = Eigen::Isometry3d::Identity();
    // The camera is tilted, so that no column of pixels runs along the edges.
    T_camera_cabinet.linear() =
        (Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(-0.6, Eigen::Vector3d::UnitY())).toRotationMatrix();
    T_camera_cabinet.translation() = Eigen::Vector3d(0, 0, 1.3);
    neighbour.pose = T_camera_cabinet * neighbour.pose;
    door.pose = T_camera_cabinet * door.pose;
    // The last that is seen of the door lies on the ray that just passes the neighbour.
    const Eigen::Vector3d seen = *door.plane().intersect(T_camera_cabinet * Eigen::Vector3d(-kGap, 0, 0));
    hidden = (door.pose.inverse() * seen).x() + door.width / 2;
  }

  static constexpr double kInset = 0.011, kGap = 0.003;  // [m]
  Rectangle neighbour, door;
  double hidden;  ///< [m] of the door's width
};

}  // namespace cabinet_articulation::core
