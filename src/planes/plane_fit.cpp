// SPDX-License-Identifier: BSD-3-Clause
#include "planes/plane_fit.h"

#include <algorithm>

namespace cabinet_articulation::core {
namespace {
constexpr double kCollinear = 1e-9;  ///< smaller shares of the points' spread are rounding
}

std::optional<DisparityPlane> PlaneFit::solve() const {
  if (n_ < 3) return std::nullopt;
  const double mean_u = u_ / n_, mean_v = v_ / n_, mean_d = d_ / n_;
  const double uu = uu_ - u_ * mean_u, uv = uv_ - u_ * mean_v, vv = vv_ - v_ * mean_v;
  const double ud = ud_ - u_ * mean_d, vd = vd_ - v_ * mean_d;
  const double determinant = uu * vv - uv * uv;
  if (!(determinant > kCollinear * (uu + vv) * (uu + vv))) return std::nullopt;
  DisparityPlane plane;
  plane.a = (ud * vv - vd * uv) / determinant;
  plane.b = (vd * uu - ud * uv) / determinant;
  plane.c = mean_d - plane.a * (mean_u + kOriginU) - plane.b * (mean_v + kOriginV);
  return plane;
}

PlaneFit PlaneFit::centred() const {
  PlaneFit moved;
  moved.n_ = n_;
  moved.uu_ = uu_ - u_ * u_ / n_;
  moved.uv_ = uv_ - u_ * v_ / n_;
  moved.vv_ = vv_ - v_ * v_ / n_;
  moved.ud_ = ud_ - u_ * d_ / n_;
  moved.vd_ = vd_ - v_ * d_ / n_;
  moved.dd_ = dd_ - d_ * d_ / n_;
  return moved;
}

double PlaneFit::squares(const DisparityPlane& plane) const {
  const double a = plane.a, b = plane.b, c = plane.at(kOriginU, kOriginV);
  const double of_plane = a * a * uu_ + b * b * vv_ + c * c * n_ + 2 * (a * b * uv_ + a * c * u_ + b * c * v_);
  return std::max(dd_ - 2 * (a * ud_ + b * vd_ + c * d_) + of_plane, 0.0);
}

}  // namespace cabinet_articulation::core
