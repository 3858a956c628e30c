// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/fitting/pitch_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "articulation/fitting/residual_correlation.h"
#include "articulation/fitting/typical_noise.h"
#include "articulation/observations/pose_sequence.h"
#include "geometry/median.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kRounds = 4;        ///< of reweighting (ours)
constexpr double kCommon = 0.01;  ///< share of the noise's variance that all poses of a track have in common (ours)

double robustSigma(std::vector<double> residuals) {
  for (double& residual : residuals) residual = std::abs(residual);
  return std::max(kLogRounding, kDeviationToSigma * median(std::move(residuals)));
}

/// How much of the information in residuals is independent, where some follow one another. They are cut at `limit`.
double shareOfInformation(std::vector<double> residuals, double limit) {
  for (double& residual : residuals) residual = std::clamp(residual, -limit, limit);
  const double share = independentShare(correlationWithNext(residuals));
  return share / (1 + kCommon * share * static_cast<double>(residuals.size()));
}

}  // namespace

PitchEstimate PitchFit::solve(double degrees_of_freedom) const {
  Row x = Row::Zero();
  Normal normal;
  for (int round = 0; round < kRounds; ++round) {
    normal = 1e-9 * Normal::Identity();
    normal(5, 5) += 1 / (typical_pitch_ * typical_pitch_);
    Row right = Row::Zero();
    add(positions_, x, round == 0 ? kTypicalPositionNoise : 0, degrees_of_freedom, &normal, &right);
    add(orientations_, x, round == 0 ? kTypicalOrientationNoise : 0, degrees_of_freedom, &normal, &right);
    x = normal.ldlt().solve(right);
  }
  return {x[5], normal.inverse()(5, 5)};
}

void PitchFit::add(const std::vector<Equation>& equations, const Row& x, double sigma, double degrees_of_freedom, Normal* normal,
                   Row* right) {
  if (equations.empty()) return;
  const bool knows_residuals = sigma == 0;
  std::vector<double> residuals;
  for (const Equation& equation : equations) residuals.push_back(equation.residual - equation.row.dot(x));
  if (knows_residuals) sigma = robustSigma(residuals);
  const double share = shareOfInformation(residuals, kOutlierSigmas * sigma);
  for (std::size_t i = 0; i < equations.size(); ++i) {
    const Equation& equation = equations[i];
    const double square = knows_residuals ? equation.seen * std::pow(residuals[i] / sigma, 2) : 0;
    const double robust = (degrees_of_freedom + 1) / (degrees_of_freedom + square);  // of Student's t
    const double weight = share * equation.seen * robust / (sigma * sigma);
    *normal += weight * equation.row * equation.row.transpose();
    *right += weight * equation.residual * equation.row;
  }
}

}  // namespace cabinet_articulation::core
