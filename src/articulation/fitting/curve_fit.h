// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "articulation/observations/pose_sequence.h"
#include "articulation/paths/pose_curve.h"
#include "cabinet_articulation/articulation/articulation_config.h"

namespace cabinet_articulation::core {

/// A smooth curve through poses.
struct CurveFit {
  PoseCurve curve;               ///< q: length [m] of the way of the positions
  std::vector<double> q;         ///< of every pose
  double position_scale = 0;     ///< [m]
  double orientation_scale = 0;  ///< [rad]
  double cost = 0;               ///< robust sum of squared distances [m^2]
  double freedom = 0;            ///< number of independent values that describe one coordinate along the curve
  Eigen::MatrixXd covariance;    ///< of one coordinate of the knots, in units of its squared scale
};

/// A principal curve: alternates between its knots and the places of the poses along it. The knots are the smoothest that poses
/// agree with, by penalised least squares with Student's t weights. `q` are places to start from [m].
CurveFit fitCurve(const PoseSamples& samples, const std::vector<double>& q, const ArticulationConfig& config, int rounds = 30);

/// One round on from a fit to almost the same poses.
CurveFit continueCurve(const PoseSamples& samples, CurveFit last, const ArticulationConfig& config);

}  // namespace cabinet_articulation::core
