// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/observations/ambiguous_turns.h"

#include <algorithm>
#include <cmath>

#include "geometry/turn_between.h"

namespace cabinet_articulation::core {
namespace {

/// [nats] Prior log-odds against another description: a tracker that makes one mistake in a hundred poses (ours).
constexpr double kRare = 4.6;

/// [nats] Of a step to the next pose: what is farther off is an outlier. That is 12 sigma of the place, for trackers that
/// are noisier than is assumed (ours).
constexpr double kFarthest = 36;

/// Poses that are not near the last one until they are taken for the next place of the front rather than for outliers (ours).
constexpr int kPatience = 3;

/// Of squared distances: where noise is larger than is assumed, a pose between two descriptions keeps its own.
constexpr double kHalfAsFar = 0.25;

constexpr double kEighth = M_PI / 4;  ///< [rad] nearer than this, one description is nearest

/// By quarter turns about z; from the fourth on, from the back.
Eigen::Matrix3d descriptionOf(std::size_t i) {
  const Eigen::AngleAxisd quarters(static_cast<double>(i % 4) * M_PI / 2, Eigen::Vector3d::UnitZ());
  const Eigen::AngleAxisd back(i < 4 ? 0 : M_PI, Eigen::Vector3d::UnitX());
  return (quarters * back).toRotationMatrix();
}

}  // namespace

Eigen::Isometry3d AmbiguousTurns::Description::operator()(const Eigen::Isometry3d& pose) const {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() = left * pose.linear() * right;
  out.translation() = left * pose.translation();
  return out;
}

/// [nats] Of a step from one pose to another.
double AmbiguousTurns::cost(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) const {
  const double moved = (to.translation() - from.translation()).norm() / sigma_position_;
  const double turned = turnBetween(from, to) / sigma_orientation_;
  return (moved * moved + turned * turned) / 4;  // two poses err
}

bool AmbiguousTurns::areNear(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) const {
  return turnBetween(from, to) < kEighth && cost(from, to) < kFarthest;
}

AmbiguousTurns::Resolved AmbiguousTurns::resolve(const Eigen::Isometry3d& pose) {
  Resolved best{pose};
  std::size_t best_description = 0;
  if (last_ && !areNear(*last_, pose)) {
    const double as_it_is = cost(*last_, pose);
    double least = std::min(as_it_is - kRare, kHalfAsFar * as_it_is);
    for (std::size_t i = 1; i < kLefts * kRights; ++i) {
      const Description description{descriptionOf(i / kRights), descriptionOf(i % kRights)};
      const Eigen::Isometry3d other = description(pose);
      if (!areNear(*last_, other) || cost(*last_, other) >= least) continue;
      best = {other, description.swapsSides()};
      best_description = i;
      least = cost(*last_, other);
    }
  }
  ++counts_[best_description];
  follow(best.pose);
  return best;
}

/// Poses that are far from the last one, but near one another, are where the front is now.
void AmbiguousTurns::follow(const Eigen::Isometry3d& pose) {
  if (last_ && !areNear(*last_, pose)) {
    const bool agrees = far_ > 0 && areNear(elsewhere_, pose);
    far_ = agrees ? far_ + 1 : 1;
    elsewhere_ = pose;
    if (far_ < kPatience) return;
  }
  last_ = pose;
  far_ = 0;
}

AmbiguousTurns::Description AmbiguousTurns::most() const {
  const auto most = static_cast<std::size_t>(std::max_element(counts_.begin(), counts_.end()) - counts_.begin());
  return {descriptionOf(most / kRights).transpose(), descriptionOf(most % kRights).transpose()};
}

void AmbiguousTurns::redescribe(const Description& description) {
  if (last_) last_ = description(*last_);
}

}  // namespace cabinet_articulation::core
