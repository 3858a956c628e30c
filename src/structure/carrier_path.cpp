// SPDX-License-Identifier: BSD-3-Clause
#include "structure/carrier_path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "cabinet_articulation/geometry/rectangle.h"
#include "structure/seen_motion.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kRested = 0.01;  ///< [m] what returned to within this rested meanwhile (sigma_position of the original release)

}  // namespace

CarrierPath::CarrierPath(const Track& track, LearnedModel joint, double pause) : joint_(std::move(joint)), pause_(pause) {
  for (const TrackedObservation& observation : track.observations) {
    if (!observation.rectangle.pose.matrix().allFinite() || !std::isfinite(observation.stamp)) continue;
    if (!stamps_.empty() && observation.stamp <= stamps_.back()) continue;
    stamps_.push_back(observation.stamp);
    q_.push_back(joint_.configuration(observation.rectangle.pose));
  }
}

std::optional<double> CarrierPath::configurationAt(double stamp) const {
  if (stamps_.empty()) return std::nullopt;
  const auto next = static_cast<std::size_t>(std::lower_bound(stamps_.begin(), stamps_.end(), stamp) - stamps_.begin());
  if (next < stamps_.size() && stamps_[next] == stamp) return q_[next];
  if (next == 0 || next == stamps_.size()) {
    const std::size_t end = next == 0 ? 0 : next - 1;
    return std::abs(stamps_[end] - stamp) <= pause_ ? std::optional<double>(q_[end]) : std::nullopt;
  }
  const double before = stamps_[next - 1], gap = stamps_[next] - before;
  if (gap > pause_ && wayOfCorners(joint_, q_[next - 1], q_[next]) > kRested) return std::nullopt;
  return q_[next - 1] + (q_[next] - q_[next - 1]) * (stamp - before) / gap;
}

std::optional<Eigen::Isometry3d> CarrierPath::at(double stamp) const {
  const std::optional<double> q = configurationAt(stamp);
  return q ? std::optional<Eigen::Isometry3d>(joint_.predict(*q)) : std::nullopt;
}

double wayOfCorners(const LearnedModel& joint, double q, double other) {
  return distanceOfCorners({joint.predict(q), joint.width, joint.height}, {joint.predict(other), joint.width, joint.height});
}

}  // namespace cabinet_articulation::core
