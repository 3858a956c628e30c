// SPDX-License-Identifier: BSD-3-Clause
#include "kinds/shape_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "articulation/fitting/arc_fit.h"
#include "articulation/fitting/arc_problem.h"
#include "articulation/fitting/initial_arc.h"
#include "articulation/fitting/residual_correlation.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kImpossible = std::numeric_limits<double>::infinity();

ResidualNoise independent(const TrackNoise& noise) {
  ResidualNoise residual;
  residual.degrees_of_freedom = noise.degrees_of_freedom;
  residual.position = residual.placing_position = noise.position;
  residual.orientation = residual.placing_orientation = noise.orientation;
  return residual;
}

/// Gauss-Newton steps of an arc to the maximum of its posterior.
template <bool kWithOrientation>
class ShapeFitter {
 public:
  ShapeFitter(const PoseSamples& samples, const TrackNoise& noise, const ShapePrior& prior, const ArticulationConfig& config)
      : samples_(samples), noise_(independent(noise)), inflation_(noise.inflation), prior_(prior), config_(config) {}

  ShapeFit fit(Arc arc) const {
    double cost = costOf(arc);
    Step step = stepFrom(arc);
    for (int i = 0; i < kMostSteps; ++i) {
      const double before = cost;
      improve(step, &arc, &cost);
      step = stepFrom(arc);
      if (!(before - cost > kLeastGain)) break;
    }
    const Arc first = arc.recentered(arc.arcLength(samples_.positions.front()));
    return {first, logEvidence(step, arc, cost)};
  }

 private:
  using Problem = ArcProblem<kWithOrientation>;
  static constexpr int kParameters = Problem::NUM_PARAMETERS;
  using Parameters = Eigen::Matrix<double, kParameters, 1>;
  using Matrix = Eigen::Matrix<double, kParameters, kParameters>;
  static constexpr int kMostSteps = 50;
  static constexpr int kDampings = 8;
  static constexpr double kLeastGain = 1e-4;  ///< [nats]

  struct Step {
    Matrix information;
    Parameters gradient;
  };

  Problem problemOf(const Arc& arc) const {
    return {samples_, noise_, arc, prior_.mean.turns() ? Curvature::kFree : Curvature::kFixed};
  }

  bool isPossible(const Arc& arc) const {
    if (!prior_.mean.turns()) return true;
    return arc.curvature * radiusMax(samples_, config_) >= 1 && arc.curvature * config_.radius_min <= 1;
  }

  Eigen::VectorXd awayFromPrior(const Arc& arc) const {
    const Arc first = arc.recentered(arc.arcLength(samples_.positions.front()));
    const Eigen::Matrix3d start = kWithOrientation ? first.orientation : samples_.orientations.front().toRotationMatrix();
    return difference(shapeOf(first, prior_.mean.type, start), prior_.mean);
  }

  double costOf(const Arc& arc) const {
    if (!isPossible(arc)) return kImpossible;
    const Parameters zero = Parameters::Zero();
    Eigen::Matrix<double, Problem::NUM_RESIDUALS, 1> residuals;
    problemOf(arc)(zero.data(), residuals.data(), nullptr);
    return 0.5 * residuals.squaredNorm() / inflation_ + prior_.cost(awayFromPrior(arc));
  }

  Step stepFrom(const Arc& arc) const {
    const Problem problem = problemOf(arc);
    Parameters x = Parameters::Zero();
    Eigen::Matrix<double, Problem::NUM_RESIDUALS, 1> residuals;
    Eigen::Matrix<double, Problem::NUM_RESIDUALS, kParameters> jacobian;
    problem(x.data(), residuals.data(), jacobian.data());
    const Eigen::VectorXd away = awayFromPrior(arc);
    Eigen::MatrixXd by_parameters(away.size(), kParameters);
    constexpr double kDelta = 1e-6;
    for (int i = 0; i < kParameters; ++i) {
      x[i] = kDelta;
      by_parameters.col(i) = awayFromPrior(problem.arc(x.data()));
      x[i] = -kDelta;
      by_parameters.col(i) = (by_parameters.col(i) - awayFromPrior(problem.arc(x.data()))) / (2 * kDelta);
      x[i] = 0;
    }
    const Eigen::MatrixXd weighted = prior_.weight(away) * by_parameters.transpose() * prior_.precision;
    return {jacobian.transpose() * jacobian / inflation_ + weighted * by_parameters,
            jacobian.transpose() * residuals / inflation_ + weighted * away};
  }

  /// Levenberg and Marquardt's damping, until a step improves.
  void improve(const Step& step, Arc* arc, double* cost) const {
    const Problem problem = problemOf(*arc);
    double damping = 1e-6;
    for (int i = 0; i < kDampings; ++i, damping *= 10) {
      Matrix damped = step.information;
      damped.diagonal() += damping * step.information.diagonal() + Parameters::Constant(1e-9);
      const Parameters x = -damped.ldlt().solve(step.gradient);
      const Arc moved = problem.arc(x.data());
      const double moved_cost = costOf(moved);
      if (!(moved_cost < *cost)) continue;
      *arc = moved;
      *cost = moved_cost;
      return;
    }
  }

  double logEvidence(const Step& step, const Arc& arc, double cost) const {
    if (std::isinf(cost)) return -kImpossible;
    Matrix information = step.information;
    int dimensions = kParameters;
    const double scale = std::log(prior_.mean.turns() ? arc.radius() : 1.0);  // the prior is per logarithm of the radius
    if (!prior_.mean.turns())
      // A line knows neither its curvature nor its frame's rotation about itself.
      for (const int unknown : {2, 5}) {
        information.row(unknown).setZero();
        information.col(unknown).setZero();
        information(unknown, unknown) = 1;
        --dimensions;
      }
    const double log_volume = -0.5 * information.ldlt().vectorD().array().max(1e-12).log().sum();
    return -cost + prior_.log_constant + scale + log_volume + 0.5 * dimensions * std::log(2 * M_PI);
  }

  const PoseSamples& samples_;
  ResidualNoise noise_;
  double inflation_;
  const ShapePrior& prior_;
  const ArticulationConfig& config_;
};

/// Correlation of each position residual with the next, about an arc.
template <bool kWithOrientation>
double correlationAbout(const PoseSamples& samples, const ArcFit& fit, const TrackNoise& noise) {
  const ResidualNoise independent_noise = independent(noise);
  const auto residuals = ArcProblem<kWithOrientation>(samples, independent_noise, fit.arc, Curvature::kFixed).rawResiduals();
  std::vector<Eigen::Vector3d> cut;
  for (Eigen::Index i = 0; i < residuals.cols(); ++i) {
    Eigen::Vector3d residual = Eigen::Vector3d::Zero();
    const auto rows = residuals.col(i).template head<ArcProblem<kWithOrientation>::kPositionRows>();
    residual.head(rows.size()) = rows;
    cut.push_back(residual * std::min(1.0, kOutlierSigmas * noise.position / std::max(1e-12, residual.norm())));
  }
  return correlationWithNext(cut);
}

/// By how much fewer poses count. Orientations show how a front turns whatever its place says: there the least noise that a fit
/// may believe in counts for what errors of successive poses have in common. Positions alone are of a gripper that slips slowly,
/// which the begin of a motion does not show (measured: the paths of the first 30 % err by more than their residuals say).
double inflationOf(const PoseSamples& samples, const ArcFit& fit, double correlation, const ArticulationConfig& config) {
  const double inflation = config.covariance_factor * (1 + correlation) / (1 - correlation);
  if (!samples.has_orientation) return inflation;
  const double variance = fit.position_scale * fit.position_scale;
  const double limit = kOutlierSigmas * kOutlierSigmas * variance;
  double square = 0;
  for (const Eigen::Vector3d& position : samples.positions) square += std::min(fit.arc.squaredDistance(position), limit);
  return inflation * square / (2 * static_cast<double>(samples.size()) * variance);
}

}  // namespace

TrackNoise noiseOf(const PoseSamples& samples, const ArticulationConfig& config) {
  TrackNoise noise;
  const ArcFit line =
      fitArc(samples, PathShape::kLine, {consensusArc(samples, PathShape::kLine, config)}, FitEffort::fresh(), config);
  const ArcFit circle = fitArc(samples, PathShape::kCircle, {bestCircleStart(samples, config)}, FitEffort::fresh(), config);
  noise.line = line.arc;
  noise.circle = circle.arc;
  const ArcFit& better = circle.cost < line.cost ? circle : line;
  noise.position = better.position_scale;
  noise.orientation = better.orientation_scale;
  noise.degrees_of_freedom = config.degrees_of_freedom;
  const double correlation =
      samples.has_orientation ? correlationAbout<true>(samples, better, noise) : correlationAbout<false>(samples, better, noise);
  noise.inflation = std::max(1.0, inflationOf(samples, better, correlation, config));
  return noise;
}

ShapeFit fitShape(const PoseSamples& samples, const TrackNoise& noise, const ShapePrior& prior, const Arc& start,
                  const ArticulationConfig& config) {
  return samples.has_orientation ? ShapeFitter<true>(samples, noise, prior, config).fit(start)
                                 : ShapeFitter<false>(samples, noise, prior, config).fit(start);
}

Arc expectedArc(const PoseSamples& samples, const JointShape& shape) {
  Arc arc;
  arc.middle = samples.positions.front();
  arc.orientation = samples.orientations.front().toRotationMatrix();
  arc.frame = arc.orientation * shape.frame;
  arc.curvature = shape.turns() ? 1 / shape.radius : 0;
  return arc;
}

}  // namespace cabinet_articulation::core
