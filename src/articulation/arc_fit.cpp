// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/arc_fit.h"

#include <ceres/tiny_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cabinet_articulation/articulation/arc_problem.h"
#include "noise_estimate.h"

namespace cabinet_articulation::core {
namespace {

/// [nats] Fits stop when a step gains less: far less than decides anything.
constexpr double kTolerance = 0.02;

/// [nats] The same of rough fits.
constexpr double kRoughTolerance = 0.5;

/// [nats] The same where the curvature is held at its limit: there the model is wrong, and its last digits do not matter.
constexpr double kHeldTolerance = 0.5;

/// [nats] Differences above which the better model is clear.
constexpr double kClear = 40;

constexpr int kRounds = 25;
constexpr int kContinuedRounds = 4;
constexpr double kTrustRegion = 1e4;

/// Everything that depends on whether there are orientations.
template <bool kWithOrientation>
class Fitter {
 public:
  using Problem = ArcProblem<kWithOrientation>;
  using Parameters = Eigen::Matrix<double, Problem::NUM_PARAMETERS, 1>;

  struct Result {
    Arc arc;
    double cost;
  };

  Fitter(const PoseSamples& samples, const ArticulationConfig& config) : samples_(samples), config_(config) {
    // One step at a time: scales and correlations change with every step, and so does the base of the increments.
    solver_.options.max_num_iterations = 2;
    solver_.options.function_tolerance = std::numeric_limits<double>::infinity();
    solver_.options.gradient_tolerance = 1e-9;
  }

  /// Alternates between the noise and the path. Where the curvature is free but leaves its limits twice, or in the end,
  /// it is held at the limit: no crawling along it. `rival` is a cost from which the result need only differ clearly.
  template <class Noise>
  Result refine(const Arc& start, PathShape shape, Noise* noise, std::optional<double> rival,
                FitEffort effort = FitEffort::kFull) {
    const double unknown = std::numeric_limits<double>::infinity();
    Curvature curvature = shape == PathShape::kLine ? Curvature::kFixed : Curvature::kFree;
    Arc arc = start;
    Result best{start, unknown};
    int outside = 0;
    double tolerance = effort == FitEffort::kRough ? kRoughTolerance : kTolerance;
    int rounds = effort == FitEffort::kContinued ? kContinuedRounds : kRounds;
    for (int round = 0; round < rounds; ++round) {
      const Problem problem(samples_, noise->noise(), arc, curvature);
      const double cost = noise->template estimate<Problem>(problem.rawResiduals()) + problem.hingeCost();
      const double gain = best.cost - cost;
      if (gain > 0) best = {arc, cost};
      const bool leaves = curvature == Curvature::kFree && shape == PathShape::kCircle && isOutside(arc);
      outside += leaves;
      const bool settled = gain < tolerance || (!leaves && rival && isClear(best.cost, gain, *rival));
      if (!settled && outside < 2) {
        if (step(&arc, curvature, noise->noise())) continue;
      }
      if (!leaves) break;
      arc = limited(best.arc);
      curvature = Curvature::kFixed;
      tolerance = kHeldTolerance;
      best = {arc, unknown};
      outside = 0;
      rounds = std::max(rounds, round + 2);  // its cost is found in the next one
    }
    return {curvature == Curvature::kFree && shape == PathShape::kCircle ? limited(best.arc) : best.arc, best.cost};
  }

  /// J^T J at the fit.
  Eigen::MatrixXd information(const ArcFit& fit, Curvature curvature) {
    ResidualNoise noise;
    noise.degrees_of_freedom = config_.degrees_of_freedom;
    noise.position = noise.placing_position = fit.position_scale;
    noise.orientation = noise.placing_orientation = fit.orientation_scale;
    const Problem problem(samples_, noise, fit.arc, curvature);
    const Parameters zero = Parameters::Zero();
    Eigen::VectorXd residuals(problem.NumResiduals());
    Eigen::Matrix<double, Eigen::Dynamic, Problem::NUM_PARAMETERS> jacobian(problem.NumResiduals(), int(Problem::NUM_PARAMETERS));
    problem(zero.data(), residuals.data(), jacobian.data());
    return jacobian.transpose() * jacobian;
  }

 private:
  double limitedCurvature(const Arc& arc) const {
    return std::copysign(std::clamp(std::abs(arc.curvature), 1 / config_.radius_max, 1 / config_.radius_min), arc.curvature);
  }
  bool isOutside(const Arc& arc) const { return arc.curvature != limitedCurvature(arc); }

  /// Slides the centre along the radial direction of the arc's middle until the radius is allowed.
  Arc limited(Arc arc) const {
    arc.curvature = limitedCurvature(arc);
    return arc;
  }

  static bool isClear(double cost, double gain, double rival) {
    const bool won = cost < rival - kClear;
    const bool lost = cost - rival > kClear && 10 * gain < cost - rival;
    return won || lost;
  }

  /// A damped Gauss-Newton step. False: none that improves was found.
  bool step(Arc* arc, Curvature curvature, const ResidualNoise& noise) {
    const Problem problem(samples_, noise, *arc, curvature);
    for (double radius = kTrustRegion; radius > kTrustRegion * 1e-9; radius *= 1e-2) {
      solver_.options.initial_trust_region_radius = radius;
      Parameters x = Parameters::Zero();
      solver_.Solve(problem, &x);
      if (x.isZero(0)) continue;
      *arc = problem.arc(x.data());
      return true;
    }
    return false;
  }

  const PoseSamples& samples_;
  const ArticulationConfig& config_;
  ceres::TinySolver<Problem> solver_;
};

template <bool kWithOrientation>
ArcFit fitFrom(const PoseSamples& samples, PathShape shape, const Arc& start, FitEffort effort,
               const ArticulationConfig& config) {
  IndependentNoise noise(config);
  const auto result = Fitter<kWithOrientation>(samples, config).refine(start, shape, &noise, std::nullopt, effort);
  return {result.arc, noise.noise().position, noise.noise().orientation};
}

template <bool kWithOrientation>
double costOf(const PoseSamples& samples, const Arc& arc, const ArticulationConfig& config) {
  using Problem = ArcProblem<kWithOrientation>;
  IndependentNoise noise(config);
  const Problem problem(samples, noise.noise(), arc, Curvature::kFixed);
  return noise.template estimate<Problem>(problem.rawResiduals()) + problem.hingeCost();
}

template <bool kWithOrientation>
SequenceFit sequenceFrom(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const Arc& start,
                         std::optional<double> rival, const ArticulationConfig& config) {
  SequenceNoise noise(samples, config, fit.position_scale, fit.orientation_scale);
  if (rival) rival = -*rival;
  const auto result = Fitter<kWithOrientation>(samples, config).refine(start, shape, &noise, rival);
  return {result.arc, -result.cost};
}

template <bool kWithOrientation>
Eigen::MatrixXd covarianceOf(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const ArticulationConfig& config) {
  const Curvature curvature = shape == PathShape::kLine ? Curvature::kFixed : Curvature::kFree;
  const Eigen::MatrixXd information = Fitter<kWithOrientation>(samples, config).information(fit, curvature);
  // A line does not know its own frame's rotation about itself: the pseudo-inverse gives such directions no variance.
  return information.completeOrthogonalDecomposition().pseudoInverse();
}

}  // namespace

double arcCost(const PoseSamples& samples, const Arc& arc, const ArticulationConfig& config) {
  return samples.has_orientation ? costOf<true>(samples, arc, config) : costOf<false>(samples, arc, config);
}

ArcFit fitArc(const PoseSamples& samples, PathShape shape, const Arc& start, const ArticulationConfig& config, FitEffort effort) {
  return samples.has_orientation ? fitFrom<true>(samples, shape, start, effort, config)
                                 : fitFrom<false>(samples, shape, start, effort, config);
}

Eigen::MatrixXd arcCovariance(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const ArticulationConfig& config) {
  return samples.has_orientation ? covarianceOf<true>(samples, shape, fit, config)
                                 : covarianceOf<false>(samples, shape, fit, config);
}

SequenceFit fitArcSequence(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const Arc& start,
                           std::optional<double> rival, const ArticulationConfig& config) {
  return samples.has_orientation ? sequenceFrom<true>(samples, shape, fit, start, rival, config)
                                 : sequenceFrom<false>(samples, shape, fit, start, rival, config);
}

}  // namespace cabinet_articulation::core
