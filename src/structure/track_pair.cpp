// SPDX-License-Identifier: BSD-3-Clause
#include "structure/track_pair.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "closing/closed_place.h"
#include "geometry/turned_covariance.h"
#include "joints/front_place.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kLargestPart = 0.8;  ///< of the carrier's area: what is larger is the carrier itself (ours)
constexpr double kParallel = 0.1;     ///< [rad] two surfaces are one plane (measured: short fits of a direction err by as much)

TrackedObservation seenFrom(const Eigen::Isometry3d& T_world_carrier, const TrackedObservation& observation) {
  const Eigen::Isometry3d T_carrier_world = T_world_carrier.inverse();
  TrackedObservation seen = observation;
  for (Rectangle* rectangle : {&seen.rectangle, &seen.measured}) rectangle->pose = T_carrier_world * rectangle->pose;
  for (Matrix6d* covariance : {&seen.covariance, &seen.measured_covariance})
    *covariance = turned(*covariance, T_carrier_world.linear());
  return seen;
}

Track withoutObservations(const Track& track) {
  Track result = track;
  result.observations.clear();
  return result;
}

/// Where the child lies in the carrier while it is closed. Nothing if it does not close into the carrier.
std::optional<Rectangle> closedIn(const CarrierPath& carrier, const Track& child, const LearnedModel& joint, double margin) {
  if (child.observations.empty() || !leavesItsPlane(joint)) return std::nullopt;
  const std::optional<Eigen::Isometry3d> T_world_carrier = carrier.at(child.observations.front().stamp);
  if (!T_world_carrier) return std::nullopt;
  const Rectangle outline{*T_world_carrier, carrier.joint().width, carrier.joint().height};
  const double q = configurationInPlaneOf(outline, joint);
  if (!(q > joint.q_min - beyondSeen(joint) && q < joint.q_max)) return std::nullopt;
  Rectangle closed{T_world_carrier->inverse() * joint.predict(q), joint.width, joint.height};
  if (std::acos(std::min(1.0, closed.normal().z())) > kParallel) return std::nullopt;
  for (const Eigen::Vector3d& corner : closed.corners()) {
    const bool inside = std::abs(corner.x()) < outline.width / 2 + margin && std::abs(corner.y()) < outline.height / 2 + margin &&
                        std::abs(corner.z()) < margin;
    if (!inside) return std::nullopt;
  }
  const double share = closed.width * closed.height / (outline.width * outline.height);
  return share < kLargestPart ? std::optional<Rectangle>(closed) : std::nullopt;
}

void sortByStamp(Track* track) {
  std::stable_sort(track->observations.begin(), track->observations.end(),
                   [](const TrackedObservation& a, const TrackedObservation& b) { return a.stamp < b.stamp; });
}

double widestWay(const CarrierPath& carrier, const Track& track) {
  std::optional<double> least, most;
  for (const TrackedObservation& observation : track.observations) {
    const std::optional<double> q = carrier.configurationAt(observation.stamp);
    if (!q) continue;
    least = std::min(least.value_or(*q), *q);
    most = std::max(most.value_or(*q), *q);
  }
  return least ? wayOfCorners(carrier.joint(), *least, *most) : 0;
}

}  // namespace

TrackPair relativeTo(const CarrierPath& carrier, const Track& child) {
  TrackPair pair{withoutObservations(child), withoutObservations(child), 0};
  for (const TrackedObservation& observation : child.observations) {
    const std::optional<Eigen::Isometry3d> T_world_carrier = carrier.at(observation.stamp);
    if (!T_world_carrier) continue;
    pair.world.observations.push_back(observation);
    pair.relative.observations.push_back(seenFrom(*T_world_carrier, observation));
  }
  pair.carrier_way = widestWay(carrier, pair.world);
  return pair;
}

void addSeenAsPart(const CarrierPath& carrier, const Track& carrier_track, const LearnedModel& joint, double margin,
                   TrackPair* pair) {
  constexpr double kOnItsOwn =
      0.5;  // [s] around an observation of its own the child is told apart (ours: a detector misses some frames of a front)
  const std::optional<Rectangle> closed = closedIn(carrier, pair->world, joint, margin);
  if (!closed) return;
  std::vector<double> seen;
  for (const TrackedObservation& observation : pair->world.observations) seen.push_back(observation.stamp);
  for (const TrackedObservation& observation : carrier_track.observations) {
    const auto next = std::lower_bound(seen.begin(), seen.end(), observation.stamp - kOnItsOwn);
    const bool told_apart = next != seen.end() && *next <= observation.stamp + kOnItsOwn;
    const std::optional<Eigen::Isometry3d> T_world_carrier = carrier.at(observation.stamp);
    if (told_apart || !T_world_carrier) continue;
    TrackedObservation part = observation;
    part.rectangle = part.measured = {*T_world_carrier * closed->pose, closed->width, closed->height};
    pair->world.observations.push_back(part);
    pair->relative.observations.push_back(seenFrom(*T_world_carrier, part));
  }
  sortByStamp(&pair->world);
  sortByStamp(&pair->relative);
  pair->carrier_way = widestWay(carrier, pair->world);
}

}  // namespace cabinet_articulation::core
