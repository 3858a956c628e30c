// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "articulation/paths/arc.h"
#include "cabinet_articulation/articulation/learned_model.h"
#include "cabinet_articulation/kinds/joint_shape.h"

namespace cabinet_articulation::core {

/// Whether it has a JointShape: not joints of other types, nor one of a file whose radius does not lead to its axis.
bool hasShape(const LearnedModel& joint);

/// Of a joint that hasShape(), with its front's size and id. `start`: orientation of the front at q = 0. A front whose size is
/// known opens outwards, whichever way it was seen to move first.
JointShape shapeOf(const LearnedModel& joint, const Eigen::Matrix3d& start);

/// Of an arc, as seen from its middle. `start`: orientation of the front there.
JointShape shapeOf(const Arc& arc, JointType type, const Eigen::Matrix3d& start);

/// From `mean` to `shape`, of the same type: [rad] turn of the frame as a rotation vector in that of the mean, then the
/// difference of the logarithms of the radii. Without a radius: [rad] turn of the direction about the other two axes.
Eigen::VectorXd difference(const JointShape& shape, const JointShape& mean);

/// The inverse of difference().
JointShape movedBy(const JointShape& mean, const Eigen::VectorXd& by);

/// The shape from which differences add up to zero; types are alike. Its size and range are those of the first.
JointShape meanShape(const std::vector<JointShape>& shapes);

/// Covariance of difference(joint's shape, mean), by that of a joint that hasShape().
Eigen::MatrixXd shapeCovariance(const LearnedModel& joint, const JointShape& mean);

/// Standard deviations of what is known of a joint, in the units of difference().
struct ShapeSigmas {
  double turn = 0;    ///< [rad] in whichever direction is known worst
  double radius = 0;  ///< of its logarithm
};

/// Of a joint that hasShape(), by its covariance.
ShapeSigmas shapeSigmas(const LearnedModel& joint);

}  // namespace cabinet_articulation::core
