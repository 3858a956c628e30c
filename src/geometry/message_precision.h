// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace cabinet_articulation::core {

/*
 * Messages carry rotations as unit quaternions and times as whole nanoseconds, stages as matrices and seconds. On the way there
 * and back the last bits change. So that the pipeline in one object gives the bits that the nodelets give, what goes from stage
 * to stage takes this way in both.
 */

Eigen::Quaterniond toQuaternion(const Eigen::Matrix3d& R);
Eigen::Matrix3d toRotation(const Eigen::Quaterniond& q);

/// What arrives of a pose, or a time [s], that is sent in a message.
Eigen::Isometry3d asSent(const Eigen::Isometry3d& pose);
double asSent(double stamp);

/// Whether two times [s] are of one frame, whatever they lost on the way.
bool isSameStamp(double a, double b);

}  // namespace cabinet_articulation::core
