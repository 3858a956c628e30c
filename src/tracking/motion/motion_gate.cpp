// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/motion/motion_gate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cabinet_articulation::core {
namespace {

constexpr double kFreeMotion = 0.25;   ///< price of a motion that fronts do make
constexpr double kLargestShift = 0.4;  ///< of a side: an equal neighbour is at least one side away
constexpr double kLongestPull = 0.7;   ///< [m] drawers come out no farther
constexpr double kWidestSwing = 1.8;   ///< [rad] beyond this the back cannot be told from the front

bool within(const Eigen::Vector3d& shift, const Eigen::Vector3d& limits) {
  return (shift.cwiseAbs().array() <= limits.array()).all();
}

/// [m] along the normal.
double farthestPull(double seconds, const TrackingConfig& config) {
  return std::min(config.position_tolerance + config.max_speed * seconds, kLongestPull);
}

}  // namespace

double reach(const Rectangle& from, double seconds, const TrackingConfig& config) {
  // A swing moves the centre by at most a diagonal, and the visible part of a front lies up to a diagonal off its centre.
  return farthestPull(seconds, config) + 2 * config.position_tolerance + 2 * Eigen::Vector2d(from.width, from.height).norm();
}

std::optional<double> motionDistance(const Rectangle& from, const Rectangle& to, double seconds, const TrackingConfig& config) {
  // Everything in the axes of the front where it was.
  const Eigen::Matrix3d turn = from.pose.linear().transpose() * to.pose.linear();
  const Eigen::Vector3d shift = from.pose.linear().transpose() * (to.center() - from.center());
  const double twist = std::atan2(turn(1, 0) - turn(0, 1), turn(0, 0) + turn(1, 1));
  if (std::abs(twist) > config.twist_tolerance) return std::nullopt;
  const double tilt = std::acos(std::clamp(turn(2, 2), -1.0, 1.0));
  if (tilt > std::min(config.angle_tolerance + config.max_turn_rate * seconds, kWidestSwing)) return std::nullopt;

  const double tolerance = config.position_tolerance;
  const bool unwatched = seconds > config.prediction_horizon;
  if (unwatched && shift.z() < -tolerance) return std::nullopt;
  Eigen::Vector3d limits(std::min(tolerance, kLargestShift * from.width), std::min(tolerance, kLargestShift * from.height),
                         tolerance);
  double unexplained = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& side :
       {Eigen::Vector2d(1, 0), Eigen::Vector2d(-1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(0, -1)}) {
    const Eigen::Vector3d hinge_from(side.x() * from.width / 2, side.y() * from.height / 2, 0);
    const Eigen::Vector3d hinge_to(side.x() * to.width / 2, side.y() * to.height / 2, 0);
    const Eigen::Vector3d slip = shift + turn * hinge_to - hinge_from;
    if (within(slip, limits)) unexplained = std::min(unexplained, slip.norm());
  }
  limits.z() = farthestPull(seconds, config);
  if (tilt <= config.angle_tolerance && within(shift, limits)) unexplained = std::min(unexplained, shift.head<2>().norm());
  if (!std::isfinite(unexplained)) return std::nullopt;
  return std::hypot(unexplained, kFreeMotion * cornerDistance(from, to));
}

double cornerDistance(const Rectangle& a, const Rectangle& b) {
  const auto corners_a = a.corners();
  const auto corners_b = b.corners();
  double sum = 0;
  for (int i = 0; i < 4; ++i) sum += (corners_a[i] - corners_b[i]).squaredNorm();
  return std::sqrt(sum / 4);
}

}  // namespace cabinet_articulation::core
