// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/fitting/reference_point_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "articulation/fitting/arc_fit.h"
#include "articulation/fitting/initial_arc.h"

namespace cabinet_articulation::core {
namespace {

constexpr std::size_t kComparedPoses = 50;
constexpr double kSteadySize = 0.01;  ///< [m]
constexpr std::size_t kEarly = 16;    ///< poses up to which it matters that a point far from the hinge moves more

/// Noise of the positions in shares of the way they come along the path. What hardly moves fits well and says little.
double relativeNoise(const PoseSamples& samples, const Arc& arc, const ArticulationConfig& config) {
  const double limit = outlierDistance(samples, config);
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

bool ReferencePointSearch::advance(const ObservationHistory& poses, double width, double height, bool all) {
  // Corners turn about a hinge as the middles of edges do.
  static const std::vector<ReferencePoint> kPoints{{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}};
  do {
    if (isSteady(poses, width, height)) {
      options_.clear();
      return true;
    }
    lookAt(kPoints[options_.size()], poses, width, height);
  } while (all && options_.size() < kPoints.size());
  return options_.size() == kPoints.size();
}

/// Then the centre is as good as any other point.
bool ReferencePointSearch::isSteady(const ObservationHistory& poses, double width, double height) const {
  const bool unknown = width <= 0 || height <= 0 || poses.size() < 3;
  return unknown || (poses.size() >= kEarly && poses.sizeDeviation() < kSteadySize);
}

void ReferencePointSearch::lookAt(const ReferencePoint& point, const ObservationHistory& poses, double width, double height) {
  PoseSamples samples(poses.evenlySpaced(point, kComparedPoses));
  samples.hinge = {};  // the wide arc that stands for a drawer has none
  const Arc start = options_.empty() ? bestCircleStart(samples, config_) : center_arc_.shifted(point.offset(width, height));
  const ArcFit fit = fitArc(samples, PathShape::kCircle, {start}, FitEffort::fresh(kRoughFit), config_);
  if (options_.empty()) center_arc_ = fit.arc;
  options_.push_back({point, relativeNoise(samples, fit.arc, config_)});
}

ReferencePoint ReferencePointSearch::best(const ReferencePoint* preferred) const {
  if (options_.empty()) return {};
  const auto quieter = [](const Option& a, const Option& b) { return a.noise < b.noise; };
  const auto best = std::min_element(options_.begin(), options_.end(), quieter);
  for (const Option& option : options_)
    if (preferred && option.point.x == preferred->x && option.point.y == preferred->y && option.noise < 1.1 * best->noise)
      return *preferred;
  return best->point;
}

}  // namespace cabinet_articulation::core
