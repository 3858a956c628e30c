// SPDX-License-Identifier: BSD-3-Clause
#include "structure/front_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include "cabinet_articulation/joints/joint.h"
#include "geometry/logistic.h"
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

/// Whether the child moved in the world for the most part of what the carrier did. What rests then does not hang on it. Nothing
/// if the carrier was not seen to move.
std::optional<bool> goesAlong(const CarrierPath& carrier, const Track& child, double sigma_position) {
  const TrackedObservation* last = nullptr;
  double last_q = 0;
  int along = 0, alone = 0;
  for (const TrackedObservation& observation : child.observations) {
    const std::optional<double> q = carrier.configurationAt(observation.stamp);
    if (!q) continue;
    if (last != nullptr && wayOfCorners(carrier.joint(), last_q, *q) < 2 * sigma_position) continue;
    if (last != nullptr) ++(distanceOfCorners(observation.rectangle, last->rectangle) > sigma_position ? along : alone);
    last = &observation;
    last_q = *q;
  }
  return along + alone > 0 ? std::optional<bool>(along > alone) : std::nullopt;
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

}  // namespace

std::optional<double> FrontPairs::look(const Front& child, const Front& parent, Pair* pair) {
  constexpr double kNever = -std::numeric_limits<double>::infinity();
  const CarrierPath carrier(*parent.track, *parent.model, structure_.pause);
  TrackPair seen = relativeTo(carrier, *child.track);
  pair->ratio.reset();
  if (seen.world.observations.empty()) return std::nullopt;
  const Track of_its_own = seen.relative;
  if (isJoint(*child.model) && seen.carrier_way > config_.motion_min)
    pair->ratio = ratioOf(carrier, seen.world, *child.model, config_.sigma_position);
  if (isJoint(*child.model)) addSeenAsPart(carrier, *parent.track, *child.model, structure_.margin, &seen);
  if (seen.carrier_way < config_.motion_min) return std::nullopt;
  const std::optional<bool> goes_along = goesAlong(carrier, seen.world, config_.sigma_position);
  if (!goes_along) return std::nullopt;
  pair->likely = false;
  if (!*goes_along) return kNever;
  const HangingEvidence evidence = compareWithWorld(seen, config_);
  pair->log_odds = evidence.log_odds + std::log(structure_.hanging_odds);
  pair->likely = pair->log_odds > 0;
  if (pair->likely) pair->ratio = ratioOf(carrier, of_its_own, evidence.relative, config_.sigma_position);
  return evidence.rests ? std::nullopt : std::optional<double>(evidence.log_odds);
}

std::vector<FrontPairs::Front> FrontPairs::moved(const std::vector<Track>& tracks, const std::vector<LearnedModel>& models) {
  std::vector<Front> moved;
  for (const LearnedModel& model : models) {
    const Track* track = findTrack(model.id, tracks);
    if (!model.moved || track == nullptr || track->observations.empty()) continue;
    SeenMotion& motion = motions_[model.id];
    motion.follow(*track, 2 * config_.sigma_position);
    moved.push_back({track, &model, &motion});
  }
  return moved;
}

bool FrontPairs::isDue(const Pair& pair, const Front& a, const Front& b) const {
  constexpr double kGrowth = 1.25;  // ours: a pair is looked at some three times while what was seen of it doubles
  if (pair.looked_at == 0) return true;
  const double way = a.motion->way() + b.motion->way();
  return a.motion->observations() + b.motion->observations() >= kGrowth * pair.observations ||
         (way > pair.way && way >= kGrowth * pair.way);
}

void FrontPairs::update(const std::vector<Track>& tracks, const std::vector<LearnedModel>& models) {
  refuted_.reset();
  ++updates_;
  const std::vector<Front> fronts = moved(tracks, models);
  Pair* due = nullptr;
  Front child{}, parent{};
  for (const Front& a : fronts) {
    for (const Front& b : fronts) {
      if (a.track == b.track || !isJoint(*b.model) || b.model->type == JointType::kNonparametric) continue;
      if (gapBetween(b.track->observations.back().rectangle, a.track->observations.back().rectangle) > structure_.near) continue;
      const Ids ids(a.model->id, b.model->id);
      if (pairs_.count(ids) == 0 && pairs_.size() >= static_cast<std::size_t>(structure_.most_pairs)) continue;
      Pair& pair = pairs_[ids];
      if (!isDue(pair, a, b) || (due != nullptr && pair.looked_at >= due->looked_at)) continue;
      due = &pair;
      child = a;
      parent = b;
    }
  }
  if (due != nullptr) {
    const bool was_likely = due->likely;
    const std::optional<double> evidence = look(child, parent, due);
    due->looked_at = updates_;
    due->observations = child.motion->observations() + parent.motion->observations();
    due->way = child.motion->way() + parent.motion->way();
    if (evidence && !due->likely) refuted_ = UnlikelyEdge{child.model->id, parent.model->id, *evidence, was_likely};
  }
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
  for (auto motion = motions_.begin(); motion != motions_.end();)
    motion = ids.count(motion->first) > 0 ? std::next(motion) : motions_.erase(motion);
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
  motions_.erase(id);
  noteCoupled();
}

}  // namespace cabinet_articulation::core
