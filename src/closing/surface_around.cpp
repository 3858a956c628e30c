// SPDX-License-Identifier: BSD-3-Clause
#include "closing/surface_around.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cabinet_articulation/joints/joint.h"
#include "closing/closed_place.h"
#include "geometry/median.h"

namespace cabinet_articulation::core {
namespace {

struct Weighted {
  double value = 0, weight = 0;
};

/// Half of the weight is below it.
double weightedMedian(std::vector<Weighted> values) {
  std::sort(values.begin(), values.end(), [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
  double rest = 0;
  for (const Weighted& each : values) rest += each.weight / 2;
  for (const Weighted& each : values)
    if ((rest -= each.weight) <= 0) return each.value;
  return 0;
}

/// Adds up the information of views, oldest first. The most exact one of each second counts.
class Information {
 public:
  void add(double stamp, double weight) {
    constexpr double kSharedNoise = 1;  // [s] ours: in less, a camera that is carried along has not moved on
    if (!(stamp - start_ < kSharedNoise)) {
      start_ = stamp;
      sum_ += std::exchange(most_, 0);
    }
    most_ = std::max(most_, weight);
  }

  double sum() const { return sum_ + most_; }

 private:
  double start_ = -std::numeric_limits<double>::infinity();
  double sum_ = 0, most_ = 0;
};

/// The points beside those sides beyond which the plane goes on; what is farther back or nearer elsewhere is something else.
std::vector<Eigen::Vector3d> surfacePoints(const FrontInView& seen, const OwnEdges& edges) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t side = 0; side < kSides; ++side)
    if (edges.isEdge(side) && goesOn(seen.beside[side]))
      points.insert(points.end(), seen.around[side].begin(), seen.around[side].end());
  return points;
}

}  // namespace

std::optional<Surface> surfaceAround(const LearnedModel& joint, const OwnEdges& edges, double q,
                                     const std::vector<const DepthView*>& views) {
  constexpr int kIterations = 4;  // ours: each step leaves a small part of the error before
  Surface surface{q, 0, 0};
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    std::vector<Weighted> corrections;
    Information information;
    const Rectangle front = frontAt(joint, surface.q);
    for (const DepthView* view : views) {
      const std::optional<SurfacePlane> plane = fitSurface(surfacePoints(look(*view, front, kNear), edges));
      if (!plane) continue;
      const Correction correction = correctionTo(*plane, joint, surface.q);
      corrections.push_back({correction.q, 1 / (correction.sigma * correction.sigma)});
      information.add(view->stamp, corrections.back().weight);
    }
    if (corrections.empty()) return std::nullopt;
    // The variance of a median is pi / 2 that of a mean, for Gaussian noise.
    surface.sigma = std::sqrt(M_PI / 2 / information.sum());
    const double middle = weightedMedian(corrections);
    for (Weighted& correction : corrections) correction.value = std::abs(correction.value - middle);
    surface.q += middle;
    surface.scatter = kDeviationToSigma * weightedMedian(corrections);
  }
  return surface;
}

}  // namespace cabinet_articulation::core
