// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/decision/hinge_plausibility.h"

#include <algorithm>
#include <cmath>

namespace cabinet_articulation::core {

bool isImplausibleHinge(const Candidate& candidate, const Track& front, const Eigen::Isometry3d& T_reference_center,
                        double sigma_edge) {
  constexpr double kExtents = 0.75;     // half of the diagonal of a square, and some
  constexpr double kRoundThing = 0.25;  // [m] small enough for a bottle, whose faces turn about its middle
  if (!candidate.model->traits().is_hinge) return false;
  const JointGeometry geometry = candidate.model->geometry();
  const Eigen::Isometry3d center = candidate.model->predict(0) * T_reference_center;
  Eigen::Vector3d to_axis = geometry.axis_point - center.translation();
  to_axis -= geometry.axis * geometry.axis.dot(to_axis);
  const double across = std::abs(center.linear().col(2).dot(to_axis));
  const double off_plane = std::max(front.width, front.height) < kRoundThing ? 0.4 : std::sqrt(0.5);
  const double upright = center.linear().col(2).dot(geometry.axis);
  const double unsure = sigma_edge / std::max(candidate.residuals.q_max - candidate.residuals.q_min, 1e-6);
  return to_axis.norm() > kExtents * std::max(front.width, front.height) + unsure ||
         across > off_plane * to_axis.norm() + unsure || upright * upright > 0.5;
}

}  // namespace cabinet_articulation::core
