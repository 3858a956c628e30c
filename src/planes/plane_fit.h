// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "cabinet_articulation/geometry/plane.h"

namespace cabinet_articulation::core {

/// Least squares of disparity = a u + b v + c. Noise lives in the disparity alone, so this is the right distance to
/// minimise (in 3-D the error is along the ray and grows with the square of the depth).
class PlaneFit {
 public:
  void add(double u, double v, double disparity) {
    u -= kOriginU;
    v -= kOriginV;
    n_ += 1;
    u_ += u;
    v_ += v;
    d_ += disparity;
    uu_ += u * u;
    uv_ += u * v;
    vv_ += v * v;
    ud_ += u * disparity;
    vd_ += v * disparity;
    dd_ += disparity * disparity;
  }

  void add(const PlaneFit& other) {
    n_ += other.n_;
    u_ += other.u_;
    v_ += other.v_;
    d_ += other.d_;
    uu_ += other.uu_;
    uv_ += other.uv_;
    vv_ += other.vv_;
    ud_ += other.ud_;
    vd_ += other.vd_;
    dd_ += other.dd_;
  }

  /// The same points, moved to where all have their middle: fits of parallel planes add up to one.
  PlaneFit centred() const;

  int count() const { return static_cast<int>(n_); }
  double meanU() const { return u_ / n_ + kOriginU; }
  double meanV() const { return v_ / n_ + kOriginV; }
  double meanDisparity() const { return d_ / n_; }

  /// Nothing for fewer than three points or points on one line.
  std::optional<DisparityPlane> solve() const;

  /// [px^2] of the differences from a plane. Well conditioned for disparities near zero only: give it residuals.
  double squares(const DisparityPlane& plane) const;

 private:
  // Any point inside an image keeps the sums well conditioned.
  static constexpr double kOriginU = 320, kOriginV = 240;
  double n_ = 0, u_ = 0, v_ = 0, d_ = 0, uu_ = 0, uv_ = 0, vv_ = 0, ud_ = 0, vd_ = 0, dd_ = 0;
};

}  // namespace cabinet_articulation::core
