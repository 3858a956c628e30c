// SPDX-License-Identifier: BSD-3-Clause
#include "closing/closed_place.h"

#include <cmath>

#include "cabinet_articulation/joints/joint.h"
#include "geometry/turn_between.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kAlong = 0.7;       ///< cosine: a drawer goes rather along its normal than across it (sliding doors do not)
constexpr double kAcross = 0.3;      ///< cosine: a door's axis is nearly parallel to its plane (lids and doors; measured: 0.05)
constexpr double kOvershoot = 0.02;  ///< [m or rad] that noise may carry an observation beyond the closed position (measured)
constexpr double kOfRange = 0.05;    ///< the same, of the range: where joints were fitted to arcs that are not quite circles

/// The axis as the front at q sees it.
Eigen::Vector3d axisOf(const LearnedModel& joint, double q) {
  return joint.predict(q).linear().transpose() * joint.axis.normalized();
}

}  // namespace

bool leavesItsPlane(const LearnedModel& joint) {
  const double along = std::abs(joint.origin.linear().col(2).dot(joint.axis.normalized()));
  if (joint.width <= 0 || joint.height <= 0) return false;
  return joint.type == JointType::kPrismatic ? along > kAlong : joint.type == JointType::kRotational && along < kAcross;
}

Correction correctionTo(const SurfacePlane& plane, const LearnedModel& joint, double q) {
  const Eigen::Vector3d axis = axisOf(joint, q);
  if (joint.type == JointType::kPrismatic) return {plane.c(0) / axis.z(), std::sqrt(plane.covariance(0, 0)) / std::abs(axis.z())};
  const Eigen::Vector3d normal = Eigen::Vector3d(-plane.c(1), -plane.c(2), 1).normalized();
  const Eigen::Vector3d J(0, -axis.y(), axis.x());
  return {turnAbout(axis, Eigen::Vector3d::UnitZ(), normal), std::sqrt(J.dot(plane.covariance * J))};
}

double configurationInPlaneOf(const Rectangle& closed, const LearnedModel& joint) {
  const Eigen::Isometry3d T_fixed_origin = joint.predict(0);
  if (joint.type != JointType::kPrismatic)
    return turnAbout(axisOf(joint, 0), Eigen::Vector3d::UnitZ(), T_fixed_origin.linear().transpose() * closed.normal());
  return closed.normal().dot(closed.center() - T_fixed_origin.translation()) / closed.normal().dot(joint.axis.normalized());
}

bool opensOutwardsFrom(const LearnedModel& joint, double q) {
  const double open = openEnd(joint, q);
  const double beyond = open == joint.q_max ? q - joint.q_min : joint.q_max - q;
  if (beyond > kOvershoot + kOfRange * (joint.q_max - joint.q_min)) return false;
  return (joint.predict(q).inverse() * joint.predict(open).translation()).z() > 0;
}

}  // namespace cabinet_articulation::core
