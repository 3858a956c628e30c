// SPDX-License-Identifier: BSD-3-Clause
#include "structure/front_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "cabinet_articulation/joints/joint.h"
#include "structure/carrier_path.h"
#include "structure/coupling.h"
#include "structure/hanging_evidence.h"
#include "structure/track_pair.h"

namespace cabinet_articulation::core {
namespace {

/// [m] Between a front and the outline of another one, in space, at most.
double gapBetween(const Rectangle& a, const Rectangle& b) {
  const Eigen::Vector3d in_a = a.pose.inverse() * b.center();
  const Eigen::Vector3d nearest(std::clamp(in_a.x(), -a.width / 2, a.width / 2),
                                std::clamp(in_a.y(), -a.height / 2, a.height / 2), 0);
  return std::max(0.0, (in_a - nearest).norm() - std::hypot(b.width, b.height) / 2);
}

/// Whether the child moved in the world for the most part of what the carrier did. What rests then does not hang on it.
bool goesAlong(const CarrierPath& carrier, const Track& child, double sigma_position) {
  const TrackedObservation* last = nullptr;
  double last_q = 0;
  int along = 0, alone = 0;
  for (const TrackedObservation& observation : child.observations) {
    const std::optional<double> q = carrier.configurationAt(observation.stamp);
    if (!q) continue;
    if (last != nullptr && wayOfCorners(carrier.joint(), last_q, *q) < 2 * sigma_position) continue;
    if (last != nullptr) {
      double way = 0;
      for (std::size_t i = 0; i < 4; ++i)
        way = std::max(way, (observation.rectangle.corners()[i] - last->rectangle.corners()[i]).norm());
      ++(way > sigma_position ? along : alone);
    }
    last = &observation;
    last_q = *q;
  }
  return along > alone;
}

/// [m per unit of q]
double metresOf(const LearnedModel& joint) {
  const double range = joint.q_max - joint.q_min;
  return range > 0 ? wayOfCorners(joint, joint.q_min, joint.q_max) / range : 1;
}

std::optional<double> ratioOf(const CarrierPath& carrier, const Track& seen, const LearnedModel& joint, double sigma_position) {
  ConfigurationPairs q;
  for (const TrackedObservation& observation : seen.observations) {
    q.first.push_back(*carrier.configurationAt(observation.stamp));
    q.second.push_back(joint.configuration(observation.rectangle.pose));
  }
  q.first_metres = metresOf(carrier.joint());
  q.second_metres = metresOf(joint);
  return ratioOfCoupled(q, sigma_position);
}

double logistic(double x) { return 1 / (1 + std::exp(-x)); }

}  // namespace

void FrontPairs::look(const Front& child, const Front& parent, Pair* pair) {
  const CarrierPath carrier(*parent.track, *parent.model, structure_.pause);
  TrackPair seen = relativeTo(carrier, *child.track);
  pair->ratio.reset();
  if (seen.world.observations.empty()) return;
  const Track of_its_own = seen.relative;
  if (isJoint(*child.model) && seen.carrier_way > config_.motion_min)
    pair->ratio = ratioOf(carrier, seen.world, *child.model, config_.sigma_position);
  if (isJoint(*child.model)) addSeenAsPart(carrier, *parent.track, *child.model, structure_.margin, &seen);
  if (seen.carrier_way < config_.motion_min) return;
  pair->likely = false;
  if (!goesAlong(carrier, seen.world, config_.sigma_position)) return;
  const HangingEvidence evidence = compareWithWorld(seen, config_);
  pair->log_odds = evidence.log_odds + std::log(structure_.hanging_odds);
  pair->likely = pair->log_odds > 0;
  if (pair->likely) pair->ratio = ratioOf(carrier, of_its_own, evidence.relative, config_.sigma_position);
}

void FrontPairs::update(const std::vector<Track>& tracks, const std::vector<LearnedModel>& models) {
  constexpr double kGrowth = 1.25;
  refuted_.clear();
  ++updates_;
  std::vector<Front> moved;
  for (const LearnedModel& model : models) {
    const auto track = std::find_if(tracks.begin(), tracks.end(), [&](const Track& other) { return other.id == model.id; });
    if (model.moved && track != tracks.end() && !track->observations.empty()) moved.push_back({&*track, &model});
  }
  Pair* due = nullptr;
  Front child{}, parent{};
  for (const Front& a : moved) {
    for (const Front& b : moved) {
      if (a.track == b.track || !isJoint(*b.model) || b.model->type == JointType::kNonparametric) continue;
      const Ids ids(a.model->id, b.model->id);
      if (pairs_.count(ids) == 0 && pairs_.size() >= static_cast<std::size_t>(structure_.most_pairs)) continue;
      Pair& pair = pairs_[ids];
      const auto observations = static_cast<double>(a.track->observations.size() + b.track->observations.size());
      if (pair.looked_at > 0 && observations < kGrowth * static_cast<double>(pair.observations)) continue;
      if (gapBetween(b.track->observations.back().rectangle, a.track->observations.back().rectangle) > structure_.near) continue;
      if (due != nullptr && pair.looked_at >= due->looked_at) continue;
      due = &pair;
      child = a;
      parent = b;
    }
  }
  if (due == nullptr) return forgetOthers(models);
  const bool was_likely = due->likely;
  look(child, parent, due);
  due->looked_at = updates_;
  due->observations = child.track->observations.size() + parent.track->observations.size();
  if (was_likely && !due->likely) refuted_.push_back(child.model->id);
  forgetOthers(models);
  noteCoupled();
}

/// What is out of view is looked at anew when it returns.
void FrontPairs::forgetOthers(const std::vector<LearnedModel>& models) {
  std::set<std::uint32_t> ids;
  for (const LearnedModel& model : models) ids.insert(model.id);
  for (auto pair = pairs_.begin(); pair != pairs_.end();) {
    const bool in_view = ids.count(pair->first.first) > 0 && ids.count(pair->first.second) > 0;
    pair = in_view ? std::next(pair) : pairs_.erase(pair);
  }
}

std::vector<LikelyEdge> FrontPairs::edges() const {
  std::vector<LikelyEdge> edges;
  for (const auto& [ids, pair] : pairs_)
    if (pair.likely) edges.push_back({ids.first, ids.second, pair.log_odds, logistic(pair.log_odds)});
  std::stable_sort(edges.begin(), edges.end(), [](const LikelyEdge& a, const LikelyEdge& b) { return a.log_odds > b.log_odds; });
  return edges;
}

void FrontPairs::noteCoupled() {
  coupled_.clear();
  for (const auto& [ids, pair] : pairs_) {
    if (!pair.ratio) continue;
    const auto back = pairs_.find({ids.second, ids.first});
    const bool told_other_way = back != pairs_.end() && back->second.ratio;
    // Once: as the one that hangs on the other, or of fronts of the world, the later one.
    if (told_other_way &&
        (pair.likely ? back->second.likely && ids.first < ids.second : back->second.likely || ids.first < ids.second))
      continue;
    coupled_.push_back({ids.second, ids.first, *pair.ratio});
  }
}

std::optional<double> FrontPairs::ratio(std::uint32_t child, std::uint32_t parent) const {
  const auto pair = pairs_.find({child, parent});
  return pair == pairs_.end() ? std::nullopt : pair->second.ratio;
}

void FrontPairs::forget(std::uint32_t id) {
  for (auto pair = pairs_.begin(); pair != pairs_.end();)
    pair = pair->first.first == id || pair->first.second == id ? pairs_.erase(pair) : std::next(pair);
}

}  // namespace cabinet_articulation::core
