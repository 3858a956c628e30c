// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/paths/hinge_prior.h"

#include <cmath>

namespace cabinet_articulation::core {
namespace {

/// The front as it is at the arc's middle, in the world's frame.
struct Front {
  Front(const HingePrior& prior, const Arc& arc)
      : normal(arc.orientation.col(2)),
        center(arc.orientation * prior.center),
        to_axis(arc.frame.col(1) / arc.curvature - center),
        across(arc.axis().cross(normal)),
        side(across.dot(to_axis) < 0 ? -1 : 1) {
    for (int i = 0; i < 2; ++i)
      to_corner += std::copysign(prior.half_size[i], across.dot(arc.orientation.col(i))) * arc.orientation.col(i);
  }

  Eigen::Vector3d normal;
  Eigen::Vector3d center;                               ///< seen from the reference point
  Eigen::Vector3d to_axis;                              ///< from the centre
  Eigen::Vector3d across;                               ///< the axis, within the plane
  double side;                                          ///< on which the axis is
  Eigen::Vector3d to_corner = Eigen::Vector3d::Zero();  ///< from the centre to the farthest corner on that direction
};

}  // namespace

Eigen::Vector2d HingePrior::residuals(const Arc& arc) const {
  const Front front(*this, arc);
  return Eigen::Vector2d(front.normal.dot(front.to_axis), front.across.dot(front.side * front.to_axis - front.to_corner)) / sigma;
}

Eigen::Matrix<double, 2, 9> HingePrior::jacobian(const Arc& arc) const {
  const Front front(*this, arc);
  const Eigen::Vector3d inward = arc.frame.col(1) / arc.curvature;
  const Eigen::Vector3d beyond = front.side * front.to_axis - front.to_corner;
  const auto gradient = [&](const Eigen::Vector3d& normal, const Eigen::Vector3d& axis, const Eigen::Vector3d& to_axis,
                            const Eigen::Vector3d& to_corner) {
    const Eigen::Vector3d across = axis.cross(front.normal) + arc.axis().cross(normal);
    return Eigen::Vector2d(normal.dot(front.to_axis) + front.normal.dot(to_axis),
                           across.dot(beyond) + front.across.dot(front.side * to_axis - to_corner));
  };
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 2, 9> jacobian = Eigen::Matrix<double, 2, 9>::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d turn = arc.frame.col(i);
    jacobian.col(2 + i) = gradient(none, turn.cross(arc.axis()), turn.cross(inward), none);
    jacobian.col(6 + i) = gradient(turn.cross(front.normal), none, -turn.cross(front.center), turn.cross(front.to_corner));
  }
  jacobian.col(5) = gradient(none, none, -inward / arc.curvature, none);
  return jacobian / sigma;
}

}  // namespace cabinet_articulation::core
