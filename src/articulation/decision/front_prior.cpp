// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/decision/front_prior.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/median.h"

namespace cabinet_articulation::core {
namespace {

double sizeLogOdds(const Track& front, const FurniturePrior& prior) {
  const double smaller = std::min(0.0, std::log(std::max(front.width, front.height) / prior.front_side));
  return -0.5 * std::pow(smaller / prior.front_side_spread, 2);
}

/// `sigma_edge` [m]: of the way across the plane.
double directionLogOdds(const Candidate& candidate, double sigma_edge, const FurniturePrior& prior) {
  const JointTraits& traits = candidate.model->traits();
  if (!traits.moves || !traits.is_parametric || traits.turns) return 0;
  const double range = std::max(candidate.residuals.q_max - candidate.residuals.q_min, 1e-6);  // m
  const double sigma = std::min(1.0, std::hypot(prior.direction_spread, sigma_edge / range));
  const Eigen::Vector3d direction = candidate.model->predict(0).linear().transpose() * candidate.model->geometry().axis;
  // Density on the half sphere beside that of any direction.
  const auto about = [sigma](double cosine) {
    const double angle = std::acos(std::min(1.0, std::abs(cosine)));
    return std::exp(-0.5 * std::pow(angle / sigma, 2)) / (sigma * sigma);
  };
  const double sliding = (about(direction.x()) + about(direction.y())) / 2;
  const double anywhere = std::max(0.0, 1 - prior.drawer_share - prior.sliding_share);
  return std::log(prior.drawer_share * about(direction.z()) + prior.sliding_share * sliding + anywhere);
}

struct MeasuredSize {
  Eigen::Vector2d value, variance;  ///< [m, m^2]
};

/// The variances of a length's two edges add up, and the centre is their mean.
MeasuredSize sizeOf(const TrackedObservation& observation) {
  constexpr double kLeastSigma = 0.002;  // [m] of a length, as the tracker's edge_sigma
  const Rectangle& seen = observation.measured.width > 0 ? observation.measured : observation.rectangle;
  const Eigen::Matrix3d R = seen.pose.linear();
  const Eigen::Matrix3d of_center = R.transpose() * observation.measured_covariance.topLeftCorner<3, 3>() * R;
  return {{seen.width, seen.height}, (4 * of_center.diagonal().head<2>()).cwiseMax(kLeastSigma * kLeastSigma)};
}

/// [nats] For one observation beside the others.
double oddsOfSameSize(const std::vector<MeasuredSize>& sizes, std::size_t i, int axis, double unlike) {
  std::vector<double> values, variances;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    if (k == i) continue;
    values.push_back(sizes[k].value[axis]);
    variances.push_back(sizes[k].variance[axis]);
  }
  const double size = median(values), variance = sizes[i].variance[axis] + median(variances);
  if (!(size > 0)) return 0;
  return std::log(2 * unlike * size / std::sqrt(2 * M_PI * variance)) - 0.5 * std::pow(sizes[i].value[axis] - size, 2) / variance;
}

}  // namespace

double oddsOfOneFront(const Track& track, std::size_t count, const FurniturePrior& prior) {
  constexpr double kStray = 0.05;  // share of the observations of clutter that take in something else (ours)
  const auto& all = track.observations;
  std::vector<MeasuredSize> sizes;
  for (std::size_t i = all.size() - std::min(count, all.size()); i < all.size(); ++i) sizes.push_back(sizeOf(all[i]));
  const bool unknown = std::all_of(sizes.begin(), sizes.end(), [](const MeasuredSize& size) { return size.value.isZero(0); });
  if (unknown || sizes.size() < 2) return std::numeric_limits<double>::infinity();
  // A motion may rest on the one observation that agrees least.
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sizes.size(); ++i)
    least = std::min(least, oddsOfSameSize(sizes, i, 0, prior.unlike_size) + oddsOfSameSize(sizes, i, 1, prior.unlike_size) -
                                std::log(kStray));
  return least * static_cast<double>(sizes.size() - 1);
}

double frontLogOdds(const Candidate& candidate, const Track& front, const ArticulationConfig& config) {
  return sizeLogOdds(front, config.prior) + directionLogOdds(candidate, config.sigma_edge, config.prior);
}

}  // namespace cabinet_articulation::core
