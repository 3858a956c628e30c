// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/reference_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "cabinet_articulation/articulation/arc_fit.h"
#include "cabinet_articulation/articulation/arc_start.h"

namespace cabinet_articulation::core {
namespace {

constexpr std::size_t kComparedPoses = 50;
constexpr double kSteadySize = 0.01;  ///< [m]
constexpr std::size_t kEarly = 16;    ///< poses up to which it matters that a point far from the hinge moves more

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

/// Noise of the positions in shares of the way they come along the path. What hardly moves fits well and says little.
double relativeNoise(const PoseSamples& samples, const Arc& arc, const ArticulationConfig& config) {
  const double limit = 3 * config.sigma_position;
  double sum = 0, first = std::numeric_limits<double>::infinity(), last = -first;
  for (const Eigen::Vector3d& p : samples.positions) {
    const double square = arc.squaredDistance(p);
    sum += std::min(square, limit * limit);
    if (square > limit * limit) continue;
    first = std::min(first, arc.arcLength(p));
    last = std::max(last, arc.arcLength(p));
  }
  const double rms = std::sqrt(sum / static_cast<double>(samples.size()));
  return std::max(rms, config.sigma_position_floor) / std::max(last - first, 1e-3);
}

}  // namespace

ReferencePoint bestReferencePoint(const FrontPoses& poses, double width, double height, const ReferencePoint* preferred,
                                  const ArticulationConfig& config) {
  if (width <= 0 || height <= 0 || poses.size() < 3) return {};
  if (poses.size() >= kEarly && poses.sizeDeviation() < kSteadySize) return {};
  struct Option {
    ReferencePoint point;
    double noise;
  };
  std::vector<Option> options;
  Arc center_arc;
  // Corners turn about a hinge as the middles of edges do.
  for (const ReferencePoint point : {ReferencePoint{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
    const PoseSamples samples(poses.track(point, kComparedPoses));
    const Arc start = options.empty() ? bestCircleStart(samples, config) : shifted(center_arc, point.offset(width, height));
    const ArcFit fit = fitArc(samples, PathShape::kCircle, start, config, FitEffort::kRough);
    if (options.empty()) center_arc = fit.arc;
    options.push_back({point, relativeNoise(samples, fit.arc, config)});
  }
  const auto quieter = [](const Option& a, const Option& b) { return a.noise < b.noise; };
  const auto best = std::min_element(options.begin(), options.end(), quieter);
  for (const Option& option : options)
    if (preferred && option.point.x == preferred->x && option.point.y == preferred->y && option.noise < 1.1 * best->noise)
      return *preferred;
  return best->point;
}

}  // namespace cabinet_articulation::core
