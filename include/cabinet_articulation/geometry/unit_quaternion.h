// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace cabinet_articulation::core {

/*
 * Messages carry rotations as unit quaternions, stages as matrices. On the way there and back the last bits change. So that the
 * pipeline in one object gives the bits that the nodelets give, poses that go from stage to stage take this way in both.
 */

Eigen::Quaterniond toQuaternion(const Eigen::Matrix3d& R);
Eigen::Matrix3d toRotation(const Eigen::Quaterniond& q);

/// The pose as it arrives when it was sent in a message.
Eigen::Isometry3d asSent(const Eigen::Isometry3d& pose);

}  // namespace cabinet_articulation::core
