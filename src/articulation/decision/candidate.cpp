// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/decision/candidate.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "articulation/fitting/residual_correlation.h"
#include "geometry/logistic.h"

namespace cabinet_articulation::core {
namespace {

/// Residuals of which none is longer than `limit`.
std::vector<Eigen::Vector3d> cutAt(double limit, std::vector<Eigen::Vector3d> residuals) {
  for (Eigen::Vector3d& residual : residuals)
    if (residual.norm() > limit) residual *= limit / residual.norm();
  return residuals;
}

/// Beyond 1 the deviations, as far as they have them in common with the next, are larger than a joint's.
double misfit(const Candidate& candidate, const ArticulationConfig& config) {
  return std::max(candidate.persistence * candidate.outlier_share / config.outlier_share_max,
                  std::sqrt(candidate.persistence) * candidate.mean_deviation / config.deviation_max);
}

/// Correlation of the autoregressive sequence whose mean is as uncertain as that of the residuals. Noise that is slow in part has
/// a longer memory than its correlation with the next says. Sums correlations while pairs of them are positive.
double longMemory(const std::vector<Eigen::Vector3d>& cut) {
  double square = 0;
  for (const Eigen::Vector3d& residual : cut) square += residual.squaredNorm();
  if (square <= 0) return 0;
  const auto correlation = [&](std::size_t lag) {
    double product = 0;
    for (std::size_t i = lag; i < cut.size(); ++i) product += cut[i].dot(cut[i - lag]);
    return product / square;
  };
  double sum = 1;
  for (std::size_t lag = 1; lag + 1 < std::min<std::size_t>(cut.size() / 3, 40); lag += 2) {
    const double pair = correlation(lag) + correlation(lag + 1);
    if (pair <= 0) break;
    sum += 2 * pair;
  }
  return std::clamp((sum - 1) / (sum + 1), 0.0, 0.97);
}

}  // namespace

Candidate evaluateCandidate(ArticulationModel* model, const PoseSequence& track, const ArticulationConfig& config) {
  Candidate candidate;
  candidate.model = model;
  candidate.residuals = model->residuals(track);
  candidate.log_likelihood = model->logLikelihood(track, candidate.residuals);
  const double caution = track.orientation_weights.empty() ? 1 : std::max(1.0, config.sigma_position / config.sigma_plane);
  candidate.cautious_log_likelihood =
      caution > 1 ? model->logLikelihood(track, candidate.residuals, caution) : candidate.log_likelihood;
  const std::vector<Eigen::Vector3d> positions = cutAt(outlierDistance(track, config), candidate.residuals.position);
  const double turn_limit = kOutlierSigmas * sigmaOrientation(track, config);
  const std::vector<Eigen::Vector3d> orientations = cutAt(turn_limit, candidate.residuals.orientation);
  candidate.correlation = correlationWithNext(positions);
  candidate.persistence = std::max(candidate.correlation, correlationWithNext(orientations));
  candidate.memory = std::max(candidate.correlation, longMemory(positions));
  const double share = 1 / static_cast<double>(track.size());
  for (std::size_t i = 0; i < track.size(); ++i) {
    const double deviation = std::max(candidate.residuals.displaced[i], candidate.residuals.turned[i]);
    candidate.outlier_share += deviation > kOutlierSigmas ? share : 0;
    candidate.mean_deviation += share * std::min(deviation, kGrossSigmas);
  }
  return candidate;
}

bool explains(const Candidate& candidate, const ArticulationConfig& config) { return misfit(candidate, config) <= 1; }

double probabilityOfAnother(const Candidate& candidate, const ArticulationConfig& config) {
  // [nats for each e-fold] Two log-normal deviations of one spread s, the joints' about m, as likely as each other at the limit d
  // of 2 sigma_position: 2 ln(d / m) / s^2. Measured, position errors of 50 recorded joints: m = 0.23 sigma_position, s = 0.74.
  constexpr double kSteepness = 8;
  if (explains(candidate, config)) return 0;
  return logistic(kSteepness * std::log(misfit(candidate, config)));
}

}  // namespace cabinet_articulation::core
