// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "articulation/paths/arc.h"
#include "cabinet_articulation/articulation/learned_model.h"

namespace cabinet_articulation::core {

/// A prismatic or rotational joint as its front sees it where it was first seen. It does not say where the front is.
struct JointShape {
  JointType type = JointType::kPrismatic;
  /// In the front's own frame; columns: direction of opening, from the front's centre to the hinge, axis. Only the first counts
  /// where nothing turns.
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  double radius = 0;  ///< [m] from the front's centre to the axis; 0: nothing turns

  bool turns() const { return type == JointType::kRotational; }
  /// Number of parameters: two of a direction, or three of a frame and the radius.
  int dimensions() const { return turns() ? 4 : 2; }
};

/// Whether joints of this type have a JointShape.
bool hasShape(const LearnedModel& joint);

/// Of a joint that hasShape(). `start`: orientation of the front at q = 0.
JointShape shapeOf(const LearnedModel& joint, const Eigen::Matrix3d& start);

/// Of an arc, as seen from its middle. `start`: orientation of the front there.
JointShape shapeOf(const Arc& arc, JointType type, const Eigen::Matrix3d& start);

/// From `mean` to `shape`, of the same type: [rad] turn of the frame as a rotation vector in that of the mean, then the
/// difference of the logarithms of the radii. Without a radius: [rad] turn of the direction about the other two axes.
Eigen::VectorXd difference(const JointShape& shape, const JointShape& mean);

/// The shape from which differences add up to zero; types are alike.
JointShape meanShape(const std::vector<JointShape>& shapes);

}  // namespace cabinet_articulation::core
