// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "articulation/fitting/arc_problem.h"
#include "articulation/observations/pose_sequence.h"
#include "articulation/paths/arc.h"
#include "cabinet_articulation/articulation/articulation_config.h"

namespace cabinet_articulation::core {

enum class PathShape { kLine, kCircle };

/// [nats] Fits stop when a step gains less: far less than decides anything.
constexpr double kFineFit = 0.02;

/// [nats] The same where fits are only told apart, and where the curvature is held at its limit: the model is wrong there.
constexpr double kRoughFit = 0.5;

/// [nats] Differences in likelihood above which no other local optimum will turn the answer (measured: 24 was turned).
constexpr double kClearDifference = 40;

/// Steps after which a fit has settled, or never will (ours).
constexpr int kMostSteps = 24;

/// How long a fit goes on.
struct FitEffort {
  /// To its end; `rival` is a log-likelihood from which the result need only differ clearly.
  static FitEffort fresh(double tolerance = kFineFit, std::optional<double> rival = std::nullopt) {
    return {kMostSteps, tolerance, rival, false};
  }
  /// At most so many steps on from an earlier fit to almost the same poses.
  static FitEffort continued(int steps) { return {steps, kFineFit, std::nullopt, true}; }

  int steps;
  double tolerance;  ///< [nats] a step that gains less is the last
  std::optional<double> rival;
  bool continues;
};

/// A path fitted by robust least squares: Student's t about zero, separately for positions and orientations, whose
/// scales are estimated along.
struct ArcFit {
  Arc arc;
  double position_scale = 0;     ///< [m] 0: not estimated yet
  double orientation_scale = 0;  ///< [rad]
  double cost = 0;               ///< negative log-likelihood, up to a constant that all paths share
};

/// Negative log-likelihood of a path, up to a constant that all paths share.
double arcCost(const PoseSamples& samples, const Arc& arc, const ArticulationConfig& config);

/// The best path near `start`. Circles respect the radius limits of `config`.
ArcFit fitArc(const PoseSamples& samples, PathShape shape, const ArcFit& start, const FitEffort& effort,
              const ArticulationConfig& config);

/// Inverse of the Gauss-Newton matrix at the fit, in the order of ArcProblem's parameters (9, or 6 without
/// orientation), for independent residuals. Rows of parameters that the shape fixes are zero.
Eigen::MatrixXd arcCovariance(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const ArticulationConfig& config);

/// A path fitted to residuals that follow one another.
struct SequenceFit {
  Arc arc;
  double log_likelihood = 0;  ///< up to a constant that all paths share
  ResidualNoise noise;
  bool settled = true;  ///< more steps would gain nothing
};

/// What a fresh sequence fit starts from.
SequenceFit sequenceStart(const PoseSamples& samples, const ArcFit& fit, const Arc& start, const ArticulationConfig& config);

/// The most likely path near `start` when residuals are an autoregressive sequence of first order with Student's t innovations.
/// It tells a bowed drawer from a door, where slip and calibration make residuals follow one another. It is good for choosing and
/// bad for parameters (measured). `fit` gives the scales that place poses along the path. A result that is clearly better or
/// worse than a rival need not be the best. Without any step only the noise is found.
SequenceFit fitArcSequence(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const SequenceFit& start,
                           const FitEffort& effort, const ArticulationConfig& config);

}  // namespace cabinet_articulation::core
