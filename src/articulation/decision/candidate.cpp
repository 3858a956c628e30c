// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/decision/candidate.h"

#include <algorithm>
#include <cmath>

namespace cabinet_articulation::core {
namespace {

/// Standard deviations beyond which a pose is no worse: half its square is the cost of a gross error in articulation_model.cpp.
constexpr double kGross = 5;

/// Correlation of each residual with the next. Residuals are cut at 3 sigma, so that single outliers do not hide it.
double sequenceCorrelation(const std::vector<Eigen::Vector3d>& residuals, double limit) {
  double product = 0, square = 0;
  Eigen::Vector3d previous = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& residual : residuals) {
    const Eigen::Vector3d cut = residual * std::min(1.0, limit / std::max(1e-12, residual.norm()));
    product += cut.dot(previous);
    square += cut.squaredNorm();
    previous = cut;
  }
  return square > 0 ? std::clamp(product / square, 0.0, 0.99) : 0;
}

/// Correlation of the autoregressive sequence whose mean is as uncertain as that of the residuals: noise of which a part is
/// slow forgets later than its correlation from one to the next says. Sums correlations while pairs of them are positive.
double longMemory(const std::vector<Eigen::Vector3d>& residuals, double limit) {
  std::vector<Eigen::Vector3d> cut;
  double square = 0;
  for (const Eigen::Vector3d& residual : residuals) {
    cut.push_back(residual * std::min(1.0, limit / std::max(1e-12, residual.norm())));
    square += cut.back().squaredNorm();
  }
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
  const double limit = 3 * sigmaPosition(track, config);
  candidate.correlation = sequenceCorrelation(candidate.residuals.position, limit);
  const double turn_limit = 3 * sigmaOrientation(track, config);
  candidate.persistence = std::max(candidate.correlation, sequenceCorrelation(candidate.residuals.orientation, turn_limit));
  candidate.memory = std::max(candidate.correlation, longMemory(candidate.residuals.position, limit));
  const double share = 1 / static_cast<double>(track.size());
  for (std::size_t i = 0; i < track.size(); ++i) {
    const double deviation = std::max(candidate.residuals.displaced[i], candidate.residuals.turned[i]);
    candidate.outlier_share += deviation > 3 ? share : 0;
    candidate.mean_deviation += share * std::min(deviation, kGross);
  }
  return candidate;
}

bool explains(const Candidate& candidate, const ArticulationConfig& config) {
  return candidate.persistence * candidate.outlier_share <= config.outlier_share_max &&
         std::sqrt(candidate.persistence) * candidate.mean_deviation <= config.deviation_max;
}

}  // namespace cabinet_articulation::core
