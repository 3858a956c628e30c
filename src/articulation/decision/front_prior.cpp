// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/decision/front_prior.h"

#include <algorithm>
#include <cmath>

namespace cabinet_articulation::core {
namespace {

constexpr double kDrawers = 0.9, kSlidingDoors = 0.08;  ///< shares of fronts that slide; the rest goes anywhere (ours)
constexpr double kSpread = 0.1;                         ///< [rad] of directions about those; fronts and their fits tilt (ours)

/// [m] Longer side of a front below which fronts become rare, and the standard deviation of its logarithm there: small drawers
/// are 0.2 to 0.3 m wide (ours).
constexpr double kTypicalSide = 0.3, kSideSpread = 0.5;

double sizeLogOdds(const Track& front) {
  const double smaller = std::min(0.0, std::log(std::max(front.width, front.height) / kTypicalSide));
  return -0.5 * std::pow(smaller / kSideSpread, 2);
}

double directionLogOdds(const Candidate& candidate, double sigma_edge) {
  const JointTraits& traits = candidate.model->traits();
  if (!traits.moves || !traits.is_parametric || traits.turns) return 0;
  const double range = std::max(candidate.residuals.q_max - candidate.residuals.q_min, 1e-6);
  const double sigma = std::min(1.0, std::hypot(kSpread, sigma_edge / range));
  const Eigen::Vector3d direction = candidate.model->predict(0).linear().transpose() * candidate.model->geometry().axis;
  // Density on the half sphere beside that of any direction.
  const auto about = [sigma](double cosine) {
    const double angle = std::acos(std::min(1.0, std::abs(cosine)));
    return std::exp(-0.5 * std::pow(angle / sigma, 2)) / (sigma * sigma);
  };
  const double sliding = (about(direction.x()) + about(direction.y())) / 2;
  return std::log(kDrawers * about(direction.z()) + kSlidingDoors * sliding + 1 - kDrawers - kSlidingDoors);
}

}  // namespace

double frontLogOdds(const Candidate& candidate, const Track& front, double sigma_edge) {
  return sizeLogOdds(front) + directionLogOdds(candidate, sigma_edge);
}

}  // namespace cabinet_articulation::core
