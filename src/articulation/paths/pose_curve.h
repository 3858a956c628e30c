// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace cabinet_articulation::core {

/// A smooth curve of poses: a Catmull-Rom spline through knots at equal steps of q, in positions and in quaternions, which
/// are normalised after. Beyond its ends it goes on straight.
class PoseCurve {
 public:
  /// Position and quaternion (x, y, z, w). Signs of quaternions agree along the curve; they need not be of unit length.
  using Knot = Eigen::Matrix<double, 7, 1>;
  static constexpr std::size_t kLeastKnots = 4;

  /// A point of the curve is the sum of four knots, with these weights. `slope` is their derivative by q.
  struct Weights {
    Eigen::Index first;
    Eigen::Vector4d value, slope;
  };

  PoseCurve() = default;
  /// At least kLeastKnots, the first at q_first, the last at q_last > q_first.
  PoseCurve(std::vector<Knot> knots, double q_first, double q_last);
  PoseCurve(const std::vector<Eigen::Isometry3d>& poses, double q_first, double q_last);

  double first() const { return first_; }
  double last() const { return first_ + step_ * static_cast<double>(knots_.size() - 1); }

  Eigen::Isometry3d pose(double q) const;

  /// The q nearest to a pose, where a turn by a radian counts as `metres_per_radian`. Beyond the ends, too.
  double nearest(const Eigen::Isometry3d& pose, double metres_per_radian) const;
  /// The same near a start.
  double nearestFrom(double q, const Eigen::Isometry3d& pose, double metres_per_radian) const;

  /// The same curve with another q: q_new = sign * (q - origin).
  PoseCurve reparametrised(double origin, bool reversed) const;

  static Weights weights(std::size_t knots, double first, double step, double q);

 private:
  Knot sum(Eigen::Index first, const Eigen::Vector4d& weights) const;

  std::vector<Knot> knots_;
  double first_ = 0, step_ = 1;
};

}  // namespace cabinet_articulation::core
