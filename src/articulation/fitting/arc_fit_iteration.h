// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "articulation/fitting/arc_fit.h"
#include "articulation/fitting/arc_problem.h"
#include "articulation/fitting/noise_estimate.h"
#include "articulation/fitting/tiny_solver.h"

namespace cabinet_articulation::core {

constexpr double kTrustRegion = 1e4;  ///< the default of Ceres
constexpr int kDampings = 7;          ///< tried before a step is given up

/// Negative log-likelihood of a path, with the best noise.
template <bool kWithOrientation, class Noise>
double arcCost(const PoseSamples& samples, const Arc& arc, Noise* noise) {
  using Problem = ArcProblem<kWithOrientation>;
  const Problem problem(samples, noise->noise(), arc, Curvature::kFixed);
  return noise->template estimate<Problem>(problem.rawResiduals()) + problem.hingeCost();
}

/// Steps of an arc and of its noise in turn; what of arc_fit.h depends on whether there are orientations.
template <bool kWithOrientation>
class ArcFitIteration {
 public:
  using Problem = ArcProblem<kWithOrientation>;
  using Parameters = Eigen::Matrix<double, Problem::NUM_PARAMETERS, 1>;

  struct Result {
    Arc arc;
    double cost;
    bool settled;
  };

  ArcFitIteration(const PoseSamples& samples, const ArticulationConfig& config) : samples_(samples), config_(config) {
    // One step at a time: scales and correlations change with every step, and so does the base of the increments.
    solver_.options = optionsWithoutLeastGain<ceres::TinySolver<Problem>>();
    solver_.options.max_num_iterations = 1 + kDampings;
    solver_.options.initial_trust_region_radius = kTrustRegion;
    solver_.options.gradient_tolerance = 1e-9;
  }

  /// Alternates between the noise and the path. Where the curvature is free but leaves its limits for good, it is held at the
  /// limit: no crawling along it. A fresh fit may come back from outside once. One that continues was held at the limit before
  /// if it does not fit better inside.
  template <class Noise>
  Result fit(const Arc& start, PathShape shape, Noise* noise, FitEffort effort) {
    const double unknown = std::numeric_limits<double>::infinity();
    const bool held = shape == PathShape::kLine || (effort.continues && isHeld(start, *noise));
    Curvature curvature = held ? Curvature::kFixed : Curvature::kFree;
    int excursions = 1;
    Arc arc = start;
    Result best{start, unknown, false};
    for (int round = 0;; ++round) {
      const double cost = arcCost<kWithOrientation>(samples_, arc, noise);
      const double gain = best.cost - cost;
      if (gain > 0) best = {arc, cost, false};
      const bool outside = isLeaving(arc, curvature);
      best.settled = gain < effort.tolerance || (!outside && effort.rival && isClear(best.cost, gain, -*effort.rival));
      bool holds = outside && (best.settled || excursions-- == 0);
      if (!holds) {
        if (best.settled || round == effort.steps) break;
        best.settled = !step(&arc, curvature, noise->noise());
        if (best.settled && !outside) break;
        holds = best.settled || (effort.continues && isLeaving(arc, curvature));
      }
      if (!holds) continue;
      arc = limited(best.arc);
      curvature = Curvature::kFixed;
      best = {arc, unknown, false};
      if (!effort.continues) effort.tolerance = kRoughFit;
      effort.steps = std::max(effort.steps, round + 2);  // a step at the limit, and its cost
    }
    if (shape == PathShape::kCircle) best.arc = limited(best.arc);
    return best;
  }

  /// J^T J at the fit.
  Eigen::MatrixXd information(const ArcFit& fit, Curvature curvature) {
    ResidualNoise noise;
    noise.degrees_of_freedom = config_.degrees_of_freedom;
    noise.position = noise.placing_position = fit.position_scale;
    noise.orientation = noise.placing_orientation = fit.orientation_scale;
    const Problem problem(samples_, noise, fit.arc, curvature);
    const Parameters zero = Parameters::Zero();
    Eigen::Matrix<double, Problem::NUM_RESIDUALS, 1> residuals;
    Eigen::Matrix<double, Problem::NUM_RESIDUALS, Problem::NUM_PARAMETERS> jacobian;
    problem(zero.data(), residuals.data(), jacobian.data());
    return jacobian.transpose() * jacobian;
  }

 private:
  /// Is the curvature at its limit, and would the path fit worse inside?
  template <class Noise>
  bool isHeld(const Arc& arc, Noise noise) const {
    constexpr double kInside = 1.02;
    Arc inside = arc;
    const double size = std::abs(arc.curvature);
    if (size == 1 / radiusMax(samples_, config_)) inside.curvature *= kInside;
    if (size == 1 / config_.radius_min) inside.curvature /= kInside;
    if (inside.curvature == arc.curvature) return false;
    const double cost = arcCost<kWithOrientation>(samples_, arc, &noise);
    return arcCost<kWithOrientation>(samples_, inside, &noise) >= cost;
  }

  double limitedCurvature(const Arc& arc) const {
    return std::copysign(std::clamp(std::abs(arc.curvature), 1 / radiusMax(samples_, config_), 1 / config_.radius_min),
                         arc.curvature);
  }
  bool isLeaving(const Arc& arc, Curvature curvature) const {
    return curvature == Curvature::kFree && arc.curvature != limitedCurvature(arc);
  }

  /// Slides the centre along the radial direction of the arc's middle until the radius is allowed.
  Arc limited(Arc arc) const {
    arc.curvature = limitedCurvature(arc);
    return arc;
  }

  static bool isClear(double cost, double gain, double rival) {
    const bool won = cost < rival - kClearDifference;
    const bool lost = cost - rival > kClearDifference && 10 * gain < cost - rival;
    return won || lost;
  }

  /// A damped Gauss-Newton step. False: none that improves was found.
  bool step(Arc* arc, Curvature curvature, const ResidualNoise& noise) {
    const Problem problem(samples_, noise, *arc, curvature);
    Parameters x = Parameters::Zero();
    solver_.Solve(problem, &x);
    *arc = problem.arc(x.data());
    return !x.isZero(0);
  }

  const PoseSamples& samples_;
  const ArticulationConfig& config_;
  ceres::TinySolver<Problem> solver_;
};

}  // namespace cabinet_articulation::core
