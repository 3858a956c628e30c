// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/joints/joint.h"

namespace cabinet_articulation::core {

/// A pose and how certain it is.
struct UncertainPose {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  Matrix6d covariance = Matrix6d::Zero();  ///< x y z [m], rotations about x y z [rad], in the axes of the pose's frame
};

/// The front's centre at q, Eq. (8). The covariance (ours) is that of the joint, which counts the more the farther
/// q is from the middle of the range that was seen, and that of a single observation: errors of observations follow one
/// another, so that their mean is hardly better than one of them. Throws ModelError unless the model is a
/// joint, std::invalid_argument unless q is within limits::kConfiguration.
UncertainPose predictWithCovariance(const LearnedModel& model, double q);

/// The opening at which the front is nearest to a pose.
struct NearestConfiguration {
  double q = 0;                     ///< [m or rad]
  double position_residual = 0;     ///< [m] from the front's centre at q to the pose
  double orientation_residual = 0;  ///< [rad]
};

/// LearnedModel::configuration() and what is left, of any model. Throws std::invalid_argument unless the pose is within
/// limits::kFromOrigin.
NearestConfiguration nearestConfiguration(const LearnedModel& model, const Eigen::Isometry3d& pose);

/// The same for what is known to be a joint. Throws ModelError unless the model is a joint,
/// std::invalid_argument unless the pose is within limits::kFromOrigin.
NearestConfiguration findConfiguration(const LearnedModel& model, const Eigen::Isometry3d& pose);

/// Poses for a hand that holds the front while it moves from q_from to q_to in even steps, both ends included.
/// `T_front_grasp` is the hand in the front's frame (centre, x along the width, y along the height, z outwards).
/// Throws ModelError unless the model is a joint, std::invalid_argument for less than 2 or more than limits::kMostEntries steps,
/// and for openings and grasps beyond limits.h.
std::vector<UncertainPose> handlePath(const LearnedModel& model, const Eigen::Isometry3d& T_front_grasp, double q_from,
                                      double q_to, int steps);

}  // namespace cabinet_articulation::core
