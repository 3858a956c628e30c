// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/decision/systematic_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/median.h"
#include "geometry/turn_between.h"

namespace cabinet_articulation::core {
namespace {

/// Systematic error of a path's bow as a share of the noise of its poses, of whose variance a hundredth is common to all. It is
/// that of the bow of a parabola through a hundred poses.
constexpr double kSystematicBow = 0.34;

/// [m] Of the positions about the path, in each of the two directions across it.
double positionNoise(const Candidate& candidate) {
  constexpr double kToSigma = 1 / 1.1774;  // 1 / sqrt(2 ln 2), of the median of a Rayleigh distribution
  std::vector<double> distances;
  for (const Eigen::Vector3d& residual : candidate.residuals.position) distances.push_back(residual.norm());
  return kToSigma * median(std::move(distances));
}

/// [m] Of the bow of a path. A path may also bend because a gripper slips.
double sigmaBow(const Candidate& candidate, const ArticulationConfig& config) {
  const double noise = std::max(config.sigma_position_floor, positionNoise(candidate));
  return std::hypot(kSystematicBow * noise, config.sagitta_min / 2);
}

/// [rad] Of the turn along a path. Planes tell orientations better than markers do.
double sigmaTurn(const PoseSequence& track, const ArticulationConfig& config) {
  return track.is_marker ? config.sigma_orientation_floor : std::min(config.sigma_orientation, config.sigma_orientation_floor);
}

}  // namespace

double bowOfPath(const Candidate& candidate) {
  constexpr int kSteps = 8;
  const double q_min = candidate.residuals.q_min, q_max = candidate.residuals.q_max;
  const Eigen::Vector3d first = candidate.model->predict(q_min).translation();
  const Eigen::Vector3d chord = candidate.model->predict(q_max).translation() - first;
  double largest = 0;
  for (int i = 1; i < kSteps; ++i) {
    const Eigen::Vector3d p = candidate.model->predict(q_min + (q_max - q_min) * i / kSteps).translation() - first;
    const Eigen::Vector3d away = chord.norm() > 0 ? Eigen::Vector3d(p - chord * chord.dot(p) / chord.squaredNorm()) : p;
    largest = std::max(largest, away.norm());
  }
  return largest;
}

double turnAlongPath(const Candidate& candidate) {
  return turnBetween(candidate.model->predict(candidate.residuals.q_min), candidate.model->predict(candidate.residuals.q_max));
}

double largestAdvantageOfTurning(const Candidate& candidate, const Candidate& simpler, const PoseSequence& track,
                                 const ArticulationConfig& config) {
  const bool turns = candidate.model->traits().turns && !simpler.model->traits().turns;
  if (!turns || !track.orientation_weights.empty()) return std::numeric_limits<double>::infinity();
  const double bends = 0.5 * std::pow(bowOfPath(candidate) / sigmaBow(candidate, config), 2);
  const double turned = track.has_orientation ? 0.5 * std::pow(turnAlongPath(candidate) / sigmaTurn(track, config), 2) : 0;
  // Of all radii that doors have, this many others would be as far from the data: Occam's factor.
  const double z = std::sqrt(2 * (bends + turned));
  return bends + turned - std::max(0.0, std::log(config.prior.door_radius_spread * z)) + candidate.model->logPrior();
}

double largestAdvantageOfStraightness(const Candidate& simpler, const PoseSequence& track, const ArticulationConfig& config) {
  const double wide = config.prior.door_radius * std::exp(config.prior.door_radius_spread);  // m; few doors are wider
  const double way = simpler.residuals.path, bow = way * way / (8 * wide);
  const double turned = track.has_orientation ? way / wide / sigmaTurn(track, config) : 0;
  return 0.5 * (std::pow(bow / sigmaBow(simpler, config), 2) + turned * turned);
}

}  // namespace cabinet_articulation::core
