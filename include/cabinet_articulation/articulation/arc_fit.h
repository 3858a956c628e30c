// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cabinet_articulation/articulation/arc.h"
#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/articulation/pose_track.h"

namespace cabinet_articulation::core {

enum class PathShape { kLine, kCircle };

/// A path fitted by robust least squares: Student's t about zero, separately for positions and orientations, whose
/// scales are estimated along.
struct ArcFit {
  Arc arc;
  double position_scale = 0;     ///< [m]
  double orientation_scale = 0;  ///< [rad]
  double cost = 0;               ///< negative log-likelihood up to a constant; comparable between fits to one track
};

/// The best path from the given starts. `previous` scales (0: unknown) save iterations. Circles respect the radius
/// limits of `config`.
ArcFit fitArc(const PoseSamples& samples, PathShape shape, const std::vector<Arc>& starts, const ArticulationConfig& config);

/// Inverse of the Gauss-Newton matrix at the fit, in the order of ArcProblem's parameters (9, or 6 without
/// orientation), for independent residuals. Rows of parameters that the shape fixes are zero.
Eigen::MatrixXd arcCovariance(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const ArticulationConfig& config);

/// The log-likelihood of the best path when residuals are an autoregressive sequence of first order with Student's t
/// innovations: what tells a bowed drawer from a door, where slip and calibration make residuals follow one another.
/// `fit` gives the scales that place poses along the path.
double sequenceLogLikelihood(const PoseSamples& samples, PathShape shape, const ArcFit& fit, const std::vector<Arc>& starts,
                             const ArticulationConfig& config);

}  // namespace cabinet_articulation::core
