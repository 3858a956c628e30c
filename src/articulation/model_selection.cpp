// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/model_selection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cabinet_articulation/articulation/model_registry.h"

namespace cabinet_articulation::core {
namespace {

/// Motion that is less probable is not called so yet.
constexpr double kSure = 0.9;

double logistic(double x) { return 1 / (1 + std::exp(-x)); }

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

/// Largest distance [m] of the observed path from its chord.
double bow(const Candidate& candidate) {
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

/// Angle [rad] by which the front turned along the observed path.
double turn(const Candidate& candidate) {
  const Eigen::Matrix3d first = candidate.model->predict(candidate.residuals.q_min).linear();
  return Eigen::AngleAxisd(first.transpose() * candidate.model->predict(candidate.residuals.q_max).linear()).angle();
}

/// Share of a candidate's residuals that are independent of one another.
double independentShare(const Candidate& candidate) { return (1 - candidate.correlation) / (1 + candidate.correlation); }

/// [nats] Log of the odds of a model against a simpler one, for residuals of which only as many count as are independent.
double advantage(const Candidate& candidate, const Candidate& simpler, const PoseTrack& track) {
  const double independent = independentShare(candidate);
  const int parameters = candidate.model->complexity(track.has_orientation) - simpler.model->complexity(track.has_orientation);
  return independent * (candidate.log_likelihood - simpler.log_likelihood) -
         0.5 * parameters * std::log(std::max(1.0, independent * static_cast<double>(track.size())));
}

}  // namespace

Candidate evaluateCandidate(ArticulationModel* model, const PoseTrack& track, const ArticulationConfig& config) {
  Candidate candidate;
  candidate.model = model;
  candidate.residuals = model->residuals(track);
  candidate.log_likelihood = model->logLikelihood(track, candidate.residuals);
  const double limit = 3 * config.sigma_position;
  candidate.correlation = sequenceCorrelation(candidate.residuals.position, limit);
  candidate.memory = std::max(candidate.correlation, longMemory(candidate.residuals.position, limit));
  for (const Eigen::Vector3d& residual : candidate.residuals.position)
    candidate.outlier_share += residual.norm() > limit ? 1.0 / static_cast<double>(track.size()) : 0;
  return candidate;
}

Selection selectModel(std::vector<Candidate>* candidates, const PoseTrack& track, const MotionTest& test,
                      const ArticulationConfig& config) {
  Selection selection;
  selection.probabilities.assign(modelRegistry().size(), 0);
  const Candidate* still = nullptr;
  const Candidate* moving = nullptr;
  const Candidate* free = nullptr;
  for (Candidate& candidate : *candidates) {
    if (!candidate.model->moves()) {
      still = &candidate;
    } else if (!candidate.model->isParametric()) {
      free = &candidate;
    } else {
      const bool bends = bow(candidate) >= config.sagitta_min || (track.has_orientation && turn(candidate) >= config.turn_min);
      if (moving && !bends) candidate.evidence = std::min(candidate.evidence, moving->evidence);
      // A sequence forgives noise that is worse with the more complex model, and takes steady turning for slow noise.
      if (moving) {
        const double difference = independentShare(candidate) * (candidate.log_likelihood - moving->log_likelihood);
        candidate.evidence += track.has_orientation ? difference : std::min(0.0, difference);
      }
      if (!moving || candidate.evidence > moving->evidence) moving = &candidate;
    }
  }
  if (!moving) std::swap(moving, free);
  const bool open = free && moving->outlier_share > config.outlier_share_max;
  const double beyond = open ? logistic(advantage(*free, *moving, track)) : 0;
  const Candidate* best = beyond > 0.5 ? free : moving;
  double moved = best ? 1 : 0;
  if (still && best) {
    moved = logistic(advantage(*best, *still, track));
    if (moved < kSure || !test.passes(*best->model, best->residuals, track)) moved = std::min(moved, 0.5);
  }
  selection.moved = best && moved > 0.5;
  selection.explained = !selection.moved || best->outlier_share <= config.outlier_share_max;
  if (!selection.moved && still) best = still;
  if (best) selection.best = static_cast<std::size_t>(best - candidates->data());
  const auto probability = [&selection](const Candidate& candidate) -> double& {
    return selection.probabilities[static_cast<std::size_t>(candidate.model->type())];
  };
  const auto share = [moving, free](const Candidate& candidate) {
    return candidate.model->moves() && &candidate != free ? std::exp(candidate.evidence - moving->evidence) : 0;
  };
  if (still) probability(*still) = 1 - moved;
  if (free) probability(*free) = moved * beyond;
  double sum = 0;
  for (const Candidate& candidate : *candidates) sum += share(candidate);
  for (const Candidate& candidate : *candidates)
    if (share(candidate) > 0) probability(candidate) = moved * (1 - beyond) * share(candidate) / sum;
  return selection;
}

}  // namespace cabinet_articulation::core
