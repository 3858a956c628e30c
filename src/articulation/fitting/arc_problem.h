// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "articulation/observations/pose_sequence.h"
#include "articulation/paths/arc.h"

namespace cabinet_articulation::core {

/// What the residuals of a track about its path are assumed to be. It is Student's t around zero, or around a share of the
/// residual before: an autoregressive sequence of first order.
struct ResidualNoise {
  double position = 0.01;         ///< [m] scale
  double orientation = 0.1;       ///< [rad] scale
  double degrees_of_freedom = 5;  ///< of Student's t
  bool sequence = false;          ///< residuals follow one another
  double position_correlation = 0;
  double orientation_correlation = 0;
  double first_position = 0.01;    ///< [m] standard deviation of a sequence's first residual
  double first_orientation = 0.1;  ///< [rad]
  /// Position and orientation scales by which a pose is placed along the path, where both say something about it.
  double placing_position = 0.01;
  double placing_orientation = 0.1;
};

/// Which of the path's shapes a fit may choose from.
enum class Curvature { kFree, kFixed };

/// The residuals of a track about an Arc, as ceres::TinySolver takes them. Half their square sum is the negative log-likelihood
/// of the noise, up to a constant. However many poses there are, they are rotated into one residual more than there are
/// parameters. These have the same products, and cost the solver nothing. Two more residuals are those of the hinge. The best
/// place along the path of each pose is eliminated from the problem. Parameters are increments to a base arc, so that rotations
/// need no constraint.
/// 0, 1: middle (inward, along the axis), 2-4: rotation of the frame, 5: curvature, 6-8: rotation of the orientation.
template <bool kWithOrientation>
class ArcProblem {
 public:
  using Scalar = double;
  enum { NUM_PARAMETERS = kWithOrientation ? 9 : 6, NUM_RESIDUALS = NUM_PARAMETERS + 3 };
  /// Position: along, outward and along the axis (without orientation the first is always 0 and left out); rotation
  /// vector in the arc's frame.
  static constexpr int kRows = kWithOrientation ? 6 : 2;
  static constexpr int kPositionRows = kWithOrientation ? 3 : 2;
  using Residuals = Eigen::Matrix<double, kRows, Eigen::Dynamic>;

  ArcProblem(const PoseSamples& samples, const ResidualNoise& noise, const Arc& base, Curvature curvature)
      : samples_(samples), noise_(noise), base_(base), curvature_(curvature) {}

  /// `jacobian` (column-major) may be null; it is that of the base arc. At other increments all is zero, which ends a solver:
  /// a fit moves the base with every step.
  bool operator()(const double* parameters, double* residuals, double* jacobian) const;

  /// The base arc with increments applied.
  Arc arc(const double* parameters) const;

  /// Negative log-likelihood of where the base arc's axis is, where something is known about the hinge. It is that of the last
  /// two residuals, which are zero otherwise.
  double hingeCost() const;

  /// Raw residuals [m, rad] of every pose about the base arc, one column each.
  Residuals rawResiduals() const;

 private:
  bool expectsHinge() const { return kWithOrientation && samples_.hinge.sigma > 0 && base_.curvature != 0; }

  /// Products of residuals (first) and their derivatives with one another, the lower half. kColumns: 1 for residuals alone,
  /// 1 + NUM_PARAMETERS with derivatives.
  template <int kColumns>
  Eigen::Matrix<double, kColumns, kColumns> products(const Arc& arc) const;

  const PoseSamples& samples_;
  const ResidualNoise& noise_;
  Arc base_;
  Curvature curvature_;
};

extern template class ArcProblem<false>;
extern template class ArcProblem<true>;

}  // namespace cabinet_articulation::core
