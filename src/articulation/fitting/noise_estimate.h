// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "articulation/fitting/arc_problem.h"
#include "articulation/fitting/typical_noise.h"
#include "cabinet_articulation/articulation/articulation_config.h"

namespace cabinet_articulation::core {

/// Scales of residuals that are independent of one another, by fixed-point iteration; alternates with steps of the path.
class IndependentNoise {
 public:
  explicit IndependentNoise(const ArticulationConfig& config) : config_(config) {
    noise_.degrees_of_freedom = config.degrees_of_freedom;
    noise_.position = config.sigma_position;
    noise_.orientation = std::max(config.sigma_orientation, config.sigma_orientation_floor);
  }

  /// Goes on from the scales of an earlier fit, if they are not 0.
  IndependentNoise(const ArticulationConfig& config, double position_scale, double orientation_scale) : IndependentNoise(config) {
    if (position_scale == 0) return;
    noise_.position = noise_.placing_position = position_scale;
    noise_.orientation = noise_.placing_orientation = orientation_scale;
  }

  const ResidualNoise& noise() const { return noise_; }

  /// Takes the scales from raw residuals, one pose a column, and gives their negative log-likelihood up to a constant.
  template <class Problem>
  double estimate(const typename Problem::Residuals& residuals) {
    const auto positions = residuals.template topRows<Problem::kPositionRows>();
    noise_.position = scale(positions, 2, kTypicalPositionNoise, config_.sigma_position_floor, noise_.position);
    double cost = studentCost(positions, 2, noise_.position);
    if constexpr (Problem::kRows > Problem::kPositionRows) {
      const auto orientations = residuals.template bottomRows<Problem::kRows - Problem::kPositionRows>();
      noise_.orientation = scale(orientations, 3, kTypicalOrientationNoise, config_.sigma_orientation_floor, noise_.orientation);
      cost += studentCost(orientations, 3, noise_.orientation);
    }
    noise_.placing_position = noise_.position;
    noise_.placing_orientation = noise_.orientation;
    return cost;
  }

 private:
  static constexpr double kWeightOfPrior = 4;  ///< residuals (measured)

  template <class Rows>
  double scale(const Rows& residuals, int dimensions, double prior, double floor, double scale) const {
    const double nu = noise_.degrees_of_freedom;
    for (int iteration = 0; iteration < 5; ++iteration) {
      double sum = kWeightOfPrior * prior * prior;
      for (Eigen::Index i = 0; i < residuals.cols(); ++i) {
        const double square = residuals.col(i).squaredNorm();
        sum += (nu + dimensions) / (nu + square / (scale * scale)) * square;
      }
      const double next = std::max(floor, std::sqrt(sum / (dimensions * static_cast<double>(residuals.cols()) + 6)));
      const bool done = std::abs(next - scale) < 0.01 * scale;
      scale = next;
      if (done) break;
    }
    return scale;
  }

  template <class Rows>
  double studentCost(const Rows& residuals, int dimensions, double scale) const {
    const double nu = noise_.degrees_of_freedom;
    double sum = 0;
    for (Eigen::Index i = 0; i < residuals.cols(); ++i) sum += std::log1p(residuals.col(i).squaredNorm() / (nu * scale * scale));
    return 0.5 * (nu + dimensions) * sum + dimensions * static_cast<double>(residuals.cols()) * std::log(scale);
  }

  const ArticulationConfig& config_;
  ResidualNoise noise_;
};

/// The same for residuals that follow one another: correlations and the scales of innovations.
class SequenceNoise {
 public:
  /// The scales place poses along the path; orientations that vary less than their scale, which has a floor, say more.
  SequenceNoise(const PoseSamples& samples, const ArticulationConfig& config, double position_scale, double orientation_scale)
      : run_starts_(samples.run_starts), orientation_scale_(orientation_scale) {
    noise_.sequence = true;
    noise_.degrees_of_freedom = config.sequence_degrees_of_freedom;
    noise_.position = 0.001;
    noise_.orientation = 0.01;
    noise_.position_correlation = noise_.orientation_correlation = 0.5;
    noise_.placing_position = position_scale;
    noise_.placing_orientation = orientation_scale;
  }

  /// Goes on from what an earlier fit found.
  SequenceNoise(const PoseSamples& samples, const ResidualNoise& known, double position_scale, double orientation_scale)
      : run_starts_(samples.run_starts), orientation_scale_(orientation_scale), noise_(known) {
    noise_.placing_position = position_scale;
  }

  const ResidualNoise& noise() const { return noise_; }

  template <class Problem>
  double estimate(const typename Problem::Residuals& residuals) {
    double cost = estimateRows(residuals.template topRows<Problem::kPositionRows>(), 2, noise_.first_position, &noise_.position,
                               &noise_.position_correlation);
    if constexpr (Problem::kRows > Problem::kPositionRows) {
      cost += estimateRows(residuals.template bottomRows<Problem::kRows - Problem::kPositionRows>(), 3, noise_.first_orientation,
                           &noise_.orientation, &noise_.orientation_correlation);
      const double spread = noise_.orientation / std::sqrt(1 - noise_.orientation_correlation * noise_.orientation_correlation);
      noise_.placing_orientation = std::min(orientation_scale_, spread);
    }
    return cost;
  }

 private:
  static constexpr double kLargestCorrelation = 0.99;

  template <class Rows>
  double estimateRows(const Rows& residuals, int dimensions, double first_sigma, double* scale, double* correlation) const {
    const double nu = noise_.degrees_of_freedom;
    const double n = static_cast<double>(residuals.cols() - std::count(run_starts_.begin(), run_starts_.end(), 1)) + 1;
    const auto innovationSquare = [&](Eigen::Index i) {
      return (residuals.col(i) - *correlation * residuals.col(i - 1)).squaredNorm();
    };
    for (int iteration = 0; iteration < 5; ++iteration) {
      double product = 0, square = 0, innovations = kLogRounding * kLogRounding;
      for (Eigen::Index i = 1; i < residuals.cols(); ++i) {
        if (startsRun(i)) continue;
        const double innovation = innovationSquare(i);
        const double weight = (nu + dimensions) / (nu + innovation / (*scale * *scale));
        product += weight * residuals.col(i).dot(residuals.col(i - 1));
        square += weight * residuals.col(i - 1).squaredNorm();
        innovations += weight * innovation;
      }
      const double last_correlation = *correlation, last_scale = *scale;
      *correlation = std::clamp(product / (square + 4 * dimensions * *scale * *scale), 0.0, kLargestCorrelation);
      *scale = std::max(kLogRounding, std::sqrt(innovations / (dimensions * n)));
      if (std::abs(*correlation - last_correlation) < 1e-3 && std::abs(*scale - last_scale) < 1e-3 * *scale) break;
    }
    double cost = 0;
    for (Eigen::Index i = 0; i < residuals.cols(); ++i) {
      if (startsRun(i))
        cost += 0.5 * residuals.col(i).squaredNorm() / (first_sigma * first_sigma) + dimensions * std::log(first_sigma);
      else
        cost +=
            0.5 * (nu + dimensions) * std::log1p(innovationSquare(i) / (nu * *scale * *scale)) + dimensions * std::log(*scale);
    }
    return cost;
  }

  bool startsRun(Eigen::Index i) const { return run_starts_[static_cast<std::size_t>(i)] != 0; }

  const std::vector<char>& run_starts_;
  double orientation_scale_;
  ResidualNoise noise_;
};

}  // namespace cabinet_articulation::core
