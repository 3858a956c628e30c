// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/paths/nearest_on_arc.h"

#include <algorithm>
#include <cmath>

namespace cabinet_articulation::core {

ArcPlace nearestPlace(const Eigen::Vector3d& p, double curvature) {
  ArcPlace place;
  // g = curvature |p|^2 - 2 y keeps its digits where the arc is nearly straight and its centre far away.
  const double g = curvature * (p.x() * p.x() + p.y() * p.y()) - 2 * p.y();
  const double root = std::sqrt(std::max(1 + curvature * g, 1e-18));
  place.outward = g / (1 + root);
  place.cosine = (1 - curvature * p.y()) / root;
  place.sine = curvature * p.x() / root;
  // 1 - cos = sin^2 / (1 + cos) before the quarter turn.
  place.bend =
      place.cosine > 0 ? p.x() * p.x() / (root * root * (1 + place.cosine)) : (1 - place.cosine) / (curvature * curvature);
  return place;
}

ArcPlace nearestPlaceWithLength(const Eigen::Vector3d& p, double curvature) {
  ArcPlace place = nearestPlace(p, curvature);
  if (std::abs(curvature) < 1e-9) {
    place.length = p.x();
    return place;
  }
  place.theta = std::atan2(place.sine, place.cosine);
  place.length = place.theta / curvature;
  const double square = place.theta * place.theta;
  place.stretch = square < 0.0025 ? place.length * place.length * place.theta / 6 * (1 - square / 20)
                                  : (place.theta - place.sine) / (curvature * curvature);
  return place;
}

ArcPlace placeAtAngle(const Eigen::Vector3d& p, double curvature, double theta) {
  ArcPlace place;
  place.theta = theta;
  place.cosine = std::cos(theta);
  place.sine = std::sin(theta);
  place.length = theta / curvature;
  place.bend = (1 - place.cosine) / (curvature * curvature);
  place.stretch = (theta - place.sine) / (curvature * curvature);
  const double dx = p.x() - place.sine / curvature;
  const double dy = p.y() - (1 - place.cosine) / curvature;
  place.along = place.cosine * dx + place.sine * dy;
  place.outward = place.sine * dx - place.cosine * dy;
  return place;
}

}  // namespace cabinet_articulation::core
