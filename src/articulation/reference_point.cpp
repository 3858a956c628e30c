// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/reference_point.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "cabinet_articulation/articulation/arc_fit.h"
#include "cabinet_articulation/articulation/arc_start.h"

namespace cabinet_articulation::core {
namespace {

constexpr std::size_t kComparedPoses = 100;

/// The path of another point of the same front: `offset` away in the front's frame.
Arc shifted(const Arc& arc, const Eigen::Vector3d& offset) {
  Arc moved = arc;
  moved.middle = arc.middle + arc.orientation * offset;
  if (std::abs(arc.curvature) < 1e-9) return moved;
  Eigen::Vector3d inward = arc.center() - moved.middle;
  inward -= arc.axis() * arc.axis().dot(inward);
  const double radius = inward.norm();
  if (radius < 1e-6) return moved;
  const double turn = arc.curvature > 0 ? 1 : -1;
  moved.frame.col(1) = turn * inward / radius;
  moved.frame.col(0) = moved.frame.col(1).cross(arc.axis());
  moved.curvature = turn / radius;
  return moved;
}

double positionRms(const PoseSamples& samples, const Arc& arc, double limit) {
  double sum = 0;
  for (const Eigen::Vector3d& p : samples.positions) sum += std::min(arc.squaredDistance(p), limit * limit);
  return std::sqrt(sum / static_cast<double>(samples.size()));
}

}  // namespace

ReferencePoint bestReferencePoint(const FrontPoses& poses, double width, double height, const ReferencePoint* preferred,
                                  const ArticulationConfig& config) {
  if (width <= 0 || height <= 0 || poses.size() < 3) return {};
  struct Option {
    ReferencePoint point;
    double rms, radius;
  };
  std::vector<Option> options;
  Arc center_arc;
  const double limit = 3 * config.sigma_position;
  for (const ReferencePoint point :
       {ReferencePoint{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const PoseSamples samples(poses.track(point, kComparedPoses));
    const Arc start =
        options.empty() ? consensusArc(samples, PathShape::kCircle, config) : shifted(center_arc, point.offset(width, height));
    const ArcFit fit = fitArc(samples, PathShape::kCircle, start, config);
    if (options.empty()) center_arc = fit.arc;
    options.push_back({point, positionRms(samples, fit.arc, limit), std::abs(fit.arc.radius())});
  }
  // A point close to the hinge hardly moves: it fits well and says little.
  double largest = 0;
  for (const Option& option : options) largest = std::max(largest, option.radius);
  const Option* best = nullptr;
  for (const Option& option : options) {
    if (option.radius < 0.4 * largest) continue;
    if (!best || option.rms < best->rms) best = &option;
  }
  for (const Option& option : options)
    if (preferred && option.point.x == preferred->x && option.point.y == preferred->y && option.rms < 1.1 * best->rms)
      return *preferred;
  return best->point;
}

}  // namespace cabinet_articulation::core
