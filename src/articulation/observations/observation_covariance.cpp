// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/observations/observation_covariance.h"

#include <algorithm>
#include <cmath>

namespace cabinet_articulation::core {

bool reportsNoise(const TrackedObservation& observation) {
  const Rectangle& rectangle = observation.rectangle;
  return observation.covariance.allFinite() && !observation.covariance.isZero(0) && rectangle.pose.matrix().allFinite() &&
         std::isfinite(rectangle.width) && std::isfinite(rectangle.height);
}

Matrix6d totalCovariance(const TrackedObservation& observation, const ArticulationConfig& config) {
  constexpr double kLeastSide = 0.01;  // [m]
  const double plane = config.sigma_plane, edge = config.sigma_edge;
  const double width = std::max(observation.rectangle.width, kLeastSide);
  const double height = std::max(observation.rectangle.height, kLeastSide);
  Eigen::Matrix<double, 6, 1> sigmas;  // in the front's frame
  sigmas << std::hypot(plane, edge), std::hypot(plane, edge), plane, 2 * plane / height, 2 * plane / width,
      2 * edge / std::max(width, height);
  Matrix6d axes = Matrix6d::Zero();
  axes.topLeftCorner<3, 3>() = axes.bottomRightCorner<3, 3>() = observation.rectangle.pose.linear();
  return observation.covariance + axes * sigmas.cwiseAbs2().asDiagonal() * axes.transpose();
}

Matrix6d weighingCovariance(const TrackedObservation& observation, const ArticulationConfig& config) {
  const Eigen::Matrix<double, 3, 2> sides = observation.rectangle.pose.linear().leftCols<2>();
  const Eigen::Vector2d own = (sides.transpose() * observation.covariance.topLeftCorner<3, 3>() * sides).diagonal();
  Matrix6d covariance = totalCovariance(observation, config);
  const double shared = std::pow(config.sigma_edge / config.sigma_plane, 2);
  covariance.topLeftCorner<3, 3>() += sides * (shared * own).asDiagonal() * sides.transpose();
  return covariance;
}

}  // namespace cabinet_articulation::core
