// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "cabinet_articulation/articulation/arc.h"
#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/articulation/pose_track.h"

namespace cabinet_articulation::core {

enum class PathShape { kLine, kCircle };

enum class FitEffort {
  kFull,
  kRough,     ///< to within half a nat, to tell fits apart
  kContinued  ///< a few steps from an earlier fit; the next pose gives more
};

/// A path fitted by robust least squares: Student's t about zero, separately for positions and orientations, whose
/// scales are estimated along.
struct ArcFit {
  Arc arc;
  double position_scale = 0;     ///< [m]
  double orientation_scale = 0;  ///< [rad]
};

/// Negative log-likelihood of a path, up to a constant that all paths share.
double arcCost(const PoseSamples& samples, const Arc& arc, const ArticulationConfig& config);

/// The best path near `start`. Circles respect the radius limits of `config`.
ArcFit fitArc(const PoseSamples& samples, PathShape shape, const Arc& start, const ArticulationConfig& config,
              FitEffort effort = FitEffort::kFull);

/// Inverse of the Gauss-Newton matrix at the fit, in the order of ArcProblem's parameters (9, or 6 without
/// orientation), for independent residuals. Rows of parameters that the shape fixes are zero.
Eigen::MatrixXd arcCovariance(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const ArticulationConfig& config);

/// A path fitted to residuals that follow one another.
struct SequenceFit {
  Arc arc;
  double log_likelihood = 0;  ///< up to a constant that all paths share
};

/// The most likely path near `start` when residuals are an autoregressive sequence of first order with Student's t
/// innovations: what tells a bowed drawer from a door, where slip and calibration make residuals follow one another. It
/// is good for choosing and bad for parameters (measured). `fit` gives the scales that place poses along the path.
/// A result that is clearly better or worse than the likelihood `rival` need not be the best.
SequenceFit fitArcSequence(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const Arc& start,
                           std::optional<double> rival, const ArticulationConfig& config);

}  // namespace cabinet_articulation::core
