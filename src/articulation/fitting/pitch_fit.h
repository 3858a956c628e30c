// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace cabinet_articulation::core {

struct PitchEstimate {
  double value = 0;     ///< [m/rad]
  double variance = 1;  ///< [m^2/rad^2] with what all poses have in common
};

/// Robust linear least squares for the pitch of a front that turns about a known axis (ours). The axis may tilt, and the front
/// turn on it, at the same time.
class PitchFit {
 public:
  /// `typical_pitch` [m/rad]: standard deviation of pitches before any pose is seen.
  explicit PitchFit(double typical_pitch) : typical_pitch_(typical_pitch) {}

  /// Of shift, tilt (2), turn of the front (2), pitch.
  using Row = Eigen::Matrix<double, 6, 1>;

  /// [m] along the axis. `seen`: how much a residual counts beside others. In the order of the poses.
  void addPosition(double residual, const Row& row, double seen) { positions_.push_back({residual, row, seen}); }
  /// [rad] about a direction across the axis.
  void addOrientation(double residual, const Row& row, double seen) { orientations_.push_back({residual, row, seen}); }

  PitchEstimate solve(double degrees_of_freedom) const;

 private:
  struct Equation {
    double residual;
    Row row;
    double seen;
  };
  using Normal = Eigen::Matrix<double, 6, 6>;

  /// `sigma`: of the residuals; 0: to be taken from them.
  static void add(const std::vector<Equation>& equations, const Row& x, double sigma, double degrees_of_freedom, Normal* normal,
                  Row* right);

  double typical_pitch_;
  std::vector<Equation> positions_, orientations_;
};

}  // namespace cabinet_articulation::core
