// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/known_fronts.h"

#include <set>
#include <utility>

namespace cabinet_articulation::core {

namespace {

/// An arm that passes may look like a joint, in 4 frames or so; no front opens that fast (ours).
constexpr int kObservations = 10;

bool isWorthKeeping(const LearnedModel& model) { return isJoint(model) && model.support > 0 && model.observations >= kObservations; }

}  // namespace

void KnownFronts::update(std::vector<Track> tracks, const std::vector<LearnedModel>& models) {
  std::map<std::uint32_t, KnownFront> seen;
  for (const LearnedModel& model : models) seen[model.id].model = model;
  for (Track& track : tracks) {
    const auto it = seen.find(track.id);
    if (it != seen.end()) it->second.track = std::move(track);
  }
  live_.swap(seen);
  for (auto& [id, front] : seen)
    if (live_.count(id) == 0 && isWorthKeeping(front.model)) remembered_[id] = std::move(front);
  for (const auto& [id, front] : live_)
    if (isJoint(front.model)) remembered_.erase(id);
}

const LearnedModel& KnownFronts::at(std::uint32_t id) const {
  // A front that came back may have to move again before its own model tells more than the remembered one.
  for (const auto* fronts : {&remembered_, &live_}) {
    const auto it = fronts->find(id);
    if (it != fronts->end()) return it->second.model;
  }
  std::set<std::uint32_t> ids;
  for (const auto* fronts : {&live_, &remembered_})
    for (const auto& entry : *fronts) ids.insert(entry.first);
  std::string known;
  for (const std::uint32_t other : ids) known += (known.empty() ? "" : ", ") + std::to_string(other);
  throw ModelError(
      "there is no front " + std::to_string(id) +
      (known.empty()
           ? "; none was seen yet (the pipeline only works while somebody subscribes to its models, or with lazy: false)"
           : "; the fronts known are " + known));
}

std::vector<KnownFront> KnownFronts::joints() const {
  std::map<std::uint32_t, KnownFront> all = remembered_;
  for (const auto& [id, front] : live_)
    if (isWorthKeeping(front.model)) all[id] = front;
  std::vector<KnownFront> result;
  for (auto& entry : all) result.push_back(std::move(entry.second));
  return result;
}

void KnownFronts::replace(std::vector<KnownFront> fronts) {
  live_.clear();
  remembered_.clear();
  for (KnownFront& front : fronts) {
    const std::uint32_t id = front.model.id;
    remembered_[id] = std::move(front);
  }
}

}  // namespace cabinet_articulation::core
