// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/arc_fit.h"

#include <ceres/tiny_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cabinet_articulation/articulation/arc_problem.h"

namespace cabinet_articulation::core {
namespace {

/// What scales are believed to be before any residual is seen, with the weight of 4 residuals (measured).
constexpr double kPriorPosition = 0.002;
constexpr double kPriorOrientation = 0.019;

/// Smallest innovation [m], [rad] a sequence fit may believe in: rounding of logs.
constexpr double kInnovationFloor = 5e-5;

/// Fits stop when a step gains less: far less than decides anything.
constexpr double kLikelihoodTolerance = 0.02;
constexpr int kRounds = 25;
constexpr double kTrustRegion = 1e4;

double squared(double x) { return x * x; }

/// Scale of Student's t residuals (columns, `dimensions` of them independent) by fixed-point iteration.
template <class Rows>
double studentScale(const Rows& residuals, int dimensions, double nu, double prior, double floor, double scale) {
  const double n = static_cast<double>(residuals.cols());
  for (int iteration = 0; iteration < 5; ++iteration) {
    double sum = 4 * prior * prior;
    for (Eigen::Index i = 0; i < residuals.cols(); ++i) {
      const double square = residuals.col(i).squaredNorm();
      sum += (nu + dimensions) / (nu + square / (scale * scale)) * square;
    }
    const double next = std::max(floor, std::sqrt(sum / (dimensions * n + 6)));
    const bool done = std::abs(next - scale) < 0.01 * scale;
    scale = next;
    if (done) break;
  }
  return scale;
}

template <class Rows>
double studentCost(const Rows& residuals, int dimensions, double nu, double scale) {
  double sum = 0;
  for (Eigen::Index i = 0; i < residuals.cols(); ++i) sum += std::log1p(residuals.col(i).squaredNorm() / (nu * scale * scale));
  return 0.5 * (nu + dimensions) * sum + dimensions * static_cast<double>(residuals.cols()) * std::log(scale);
}

/// An autoregressive sequence of first order: innovations and their scale and correlation.
struct SequenceNoise {
  double correlation = 0;
  double scale = 0.001;
};

template <class Rows>
double innovationSquare(const Rows& residuals, Eigen::Index i, double correlation) {
  return (residuals.col(i) - correlation * residuals.col(i - 1)).squaredNorm();
}

template <class Rows>
SequenceNoise estimateSequence(const Rows& residuals, int dimensions, double nu, SequenceNoise noise) {
  for (int iteration = 0; iteration < 5; ++iteration) {
    double product = 0, square = 0, innovations = squared(kInnovationFloor);
    for (Eigen::Index i = 1; i < residuals.cols(); ++i) {
      const double innovation = innovationSquare(residuals, i, noise.correlation);
      const double weight = (nu + dimensions) / (nu + innovation / squared(noise.scale));
      product += weight * residuals.col(i).dot(residuals.col(i - 1));
      square += weight * residuals.col(i - 1).squaredNorm();
      innovations += weight * innovation;
    }
    noise.correlation = std::clamp(product / (square + 4 * dimensions * squared(noise.scale)), 0.0, 0.99);
    noise.scale = std::max(kInnovationFloor, std::sqrt(innovations / (dimensions * static_cast<double>(residuals.cols()))));
  }
  return noise;
}

template <class Rows>
double sequenceLikelihood(const Rows& residuals, int dimensions, double nu, const SequenceNoise& noise, double first_sigma) {
  const double n = static_cast<double>(residuals.cols());
  double sum = -0.5 * residuals.col(0).squaredNorm() / squared(first_sigma) - dimensions * std::log(first_sigma);
  for (Eigen::Index i = 1; i < residuals.cols(); ++i)
    sum -= 0.5 * (nu + dimensions) * std::log1p(innovationSquare(residuals, i, noise.correlation) / (nu * squared(noise.scale)));
  return sum - dimensions * (n - 1) * std::log(noise.scale);
}

ResidualNoise independentNoise(const ArticulationConfig& config) {
  ResidualNoise noise;
  noise.degrees_of_freedom = config.degrees_of_freedom;
  noise.position = config.sigma_position;
  noise.orientation = std::max(config.sigma_orientation, config.sigma_orientation_floor);
  return noise;
}

/// Everything that depends on whether there are orientations.
template <bool kWithOrientation>
class Fitter {
 public:
  using Problem = ArcProblem<kWithOrientation>;
  static constexpr int kPositionRows = Problem::kPositionRows;

  Fitter(const PoseSamples& samples, const ArticulationConfig& config) : samples_(samples), config_(config) {
    // One step at a time: scales and correlations change with every step, and so does the base of the increments.
    solver_.options.max_num_iterations = 2;
    solver_.options.function_tolerance = std::numeric_limits<double>::infinity();
    solver_.options.gradient_tolerance = 1e-9;
  }

  ArcFit independent(const Arc& start, PathShape shape) {
    ResidualNoise noise = independentNoise(config_);
    const Curvature curvature = shape == PathShape::kLine ? Curvature::kFixed : Curvature::kFree;
    const auto alternate = [this, &noise](Arc arc, Curvature curvature) { return refineIndependent(arc, curvature, &noise); };
    ArcFit fit = alternate(start, curvature);
    if (shape == PathShape::kCircle && limitCurvature(&fit.arc)) fit = alternate(fit.arc, Curvature::kFixed);
    return fit;
  }

  SequenceFit sequence(const Arc& start, PathShape shape, const ResidualNoise& noise) {
    const Curvature curvature = shape == PathShape::kLine ? Curvature::kFixed : Curvature::kFree;
    SequenceFit fit{start, 0};
    fit.log_likelihood = refineSequence(&fit.arc, curvature, noise);
    if (shape == PathShape::kCircle && limitCurvature(&fit.arc))
      fit.log_likelihood = refineSequence(&fit.arc, Curvature::kFixed, noise);
    return fit;
  }

  /// J^T J at the fit.
  Eigen::MatrixXd information(const ArcFit& fit, Curvature curvature) {
    ResidualNoise noise = independentNoise(config_);
    useScales(fit.position_scale, fit.orientation_scale, &noise);
    const Problem problem(samples_, noise, fit.arc, curvature);
    const Eigen::Matrix<double, Problem::NUM_PARAMETERS, 1> zero = Eigen::Matrix<double, Problem::NUM_PARAMETERS, 1>::Zero();
    Eigen::VectorXd residuals(problem.NumResiduals());
    Eigen::Matrix<double, Eigen::Dynamic, Problem::NUM_PARAMETERS> jacobian(problem.NumResiduals(), int(Problem::NUM_PARAMETERS));
    problem(zero.data(), residuals.data(), jacobian.data());
    return jacobian.transpose() * jacobian;
  }

 private:
  static void useScales(double position, double orientation, ResidualNoise* noise) {
    noise->position = noise->placing_position = position;
    noise->orientation = noise->placing_orientation = orientation;
  }

  /// Slides the centre along the mean radial direction until the radius is allowed. False: it was.
  bool limitCurvature(Arc* arc) const {
    const double magnitude = std::clamp(std::abs(arc->curvature), 1 / config_.radius_max, 1 / config_.radius_min);
    if (magnitude == std::abs(arc->curvature)) return false;
    arc->curvature = std::copysign(magnitude, arc->curvature);
    return true;
  }

  /// A damped Gauss-Newton step. False: none that improves was found.
  bool step(Arc* arc, Curvature curvature, const ResidualNoise& noise) {
    const Problem problem(samples_, noise, *arc, curvature);
    for (double radius = kTrustRegion; radius > kTrustRegion * 1e-9; radius *= 1e-2) {
      solver_.options.initial_trust_region_radius = radius;
      typename ceres::TinySolver<Problem>::Parameters x = ceres::TinySolver<Problem>::Parameters::Zero();
      solver_.Solve(problem, &x);
      if (x.isZero(0)) continue;
      *arc = problem.arc(x.data());
      return true;
    }
    return false;
  }

  ArcFit refineIndependent(Arc arc, Curvature curvature, ResidualNoise* noise) {
    ArcFit fit;
    fit.cost = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kRounds; ++round) {
      const auto residuals = Problem(samples_, *noise, arc, curvature).rawResiduals();
      const double nu = config_.degrees_of_freedom;
      const auto positions = residuals.template topRows<kPositionRows>();
      const double position_scale = studentScale(positions, 2, nu, kPriorPosition, config_.sigma_position_floor, noise->position);
      double orientation_scale = noise->orientation;
      double cost = studentCost(positions, 2, nu, position_scale);
      if constexpr (kWithOrientation) {
        const auto orientations = residuals.template bottomRows<Problem::kRows - kPositionRows>();
        orientation_scale =
            studentScale(orientations, 3, nu, kPriorOrientation, config_.sigma_orientation_floor, noise->orientation);
        cost += studentCost(orientations, 3, nu, orientation_scale);
      }
      const double gain = fit.cost - cost;
      if (gain > 0) fit = {arc, position_scale, orientation_scale, cost};
      if (gain < kLikelihoodTolerance) break;
      useScales(position_scale, orientation_scale, noise);
      if (!step(&arc, curvature, *noise)) break;
    }
    return fit;
  }

  double refineSequence(Arc* arc, Curvature curvature, ResidualNoise noise) {
    double best = -std::numeric_limits<double>::infinity();
    Arc next = *arc;
    SequenceNoise position{0.5, 0.001}, orientation{0.5, 0.01};
    noise.sequence = true;
    noise.degrees_of_freedom = config_.sequence_degrees_of_freedom;
    const double nu = noise.degrees_of_freedom;
    for (int round = 0; round < kRounds; ++round) {
      const auto residuals = Problem(samples_, noise, next, curvature).rawResiduals();
      const auto positions = residuals.template topRows<kPositionRows>();
      position = estimateSequence(positions, 2, nu, position);
      double likelihood = sequenceLikelihood(positions, 2, nu, position, noise.first_position);
      if constexpr (kWithOrientation) {
        const auto orientations = residuals.template bottomRows<Problem::kRows - kPositionRows>();
        orientation = estimateSequence(orientations, 3, nu, orientation);
        likelihood += sequenceLikelihood(orientations, 3, nu, orientation, noise.first_orientation);
      }
      const double gain = likelihood - best;
      if (gain > 0) {
        best = likelihood;
        *arc = next;
      }
      if (gain < kLikelihoodTolerance) break;
      noise.position = position.scale;
      noise.position_correlation = position.correlation;
      noise.orientation = orientation.scale;
      noise.orientation_correlation = orientation.correlation;
      if (!step(&next, curvature, noise)) break;
    }
    return best;
  }

  const PoseSamples& samples_;
  const ArticulationConfig& config_;
  ceres::TinySolver<Problem> solver_;
};

template <bool kWithOrientation>
ArcFit fitFrom(const PoseSamples& samples, PathShape shape, const std::vector<Arc>& starts, const ArticulationConfig& config) {
  Fitter<kWithOrientation> fitter(samples, config);
  ArcFit best;
  best.cost = std::numeric_limits<double>::infinity();
  for (const Arc& start : starts) {
    const ArcFit fit = fitter.independent(start, shape);
    if (fit.cost < best.cost) best = fit;
  }
  return best;
}

template <bool kWithOrientation>
SequenceFit sequenceFrom(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const Arc& start,
                         const ArticulationConfig& config) {
  ResidualNoise noise;
  noise.placing_position = fit.position_scale;
  noise.placing_orientation = fit.orientation_scale;
  return Fitter<kWithOrientation>(samples, config).sequence(start, shape, noise);
}

template <bool kWithOrientation>
Eigen::MatrixXd covarianceOf(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const ArticulationConfig& config) {
  const Curvature curvature = shape == PathShape::kLine ? Curvature::kFixed : Curvature::kFree;
  const Eigen::MatrixXd information = Fitter<kWithOrientation>(samples, config).information(fit, curvature);
  // A line does not know its own frame's rotation about itself: the pseudo-inverse gives such directions no variance.
  return information.completeOrthogonalDecomposition().pseudoInverse();
}

}  // namespace

ArcFit fitArc(const PoseSamples& samples, PathShape shape, const std::vector<Arc>& starts, const ArticulationConfig& config) {
  return samples.has_orientation ? fitFrom<true>(samples, shape, starts, config) : fitFrom<false>(samples, shape, starts, config);
}

Eigen::MatrixXd arcCovariance(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const ArticulationConfig& config) {
  return samples.has_orientation ? covarianceOf<true>(samples, shape, fit, config)
                                 : covarianceOf<false>(samples, shape, fit, config);
}

SequenceFit fitArcSequence(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const Arc& start,
                           const ArticulationConfig& config) {
  return samples.has_orientation ? sequenceFrom<true>(samples, shape, fit, start, config)
                                 : sequenceFrom<false>(samples, shape, fit, start, config);
}

}  // namespace cabinet_articulation::core
