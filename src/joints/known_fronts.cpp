// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/known_fronts.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "cabinet_articulation/joints/hanging.h"
#include "joints/front_names.h"
#include "tracking/motion/history.h"

namespace cabinet_articulation::core {

namespace {

/// An arm that passes may look like a joint, in 4 frames or so; no front opens that fast (ours).
constexpr int kObservations = 10;

/// What is merely likely has no support yet.
bool isWorthKeeping(const LearnedModel& model) {
  const bool established = model.support > 0 || model.doubt > 0;
  return wasJoint(model) && established && model.observations >= kObservations;
}

}  // namespace

std::vector<LearnedModel> modelsOf(const std::vector<KnownFront>& fronts) {
  std::vector<LearnedModel> models;
  for (const KnownFront& front : fronts) models.push_back(front.model);
  return models;
}

std::string inWords(const std::vector<IdChange>& changes) {
  std::string text;
  for (const IdChange& change : changes)
    text += (text.empty() ? "front " : ", front ") + std::to_string(change.from) + " of the file is front " +
            std::to_string(change.to) + " now";
  return text;
}

std::string childrenInWords(const ForgottenFront& forgotten) {
  std::string text;
  for (const std::uint32_t id : forgotten.set_down)
    text += ", and front " + std::to_string(id) + ", which hung on it, hangs on the world now";
  for (const std::uint32_t id : forgotten.lost)
    text += ", and so is front " + std::to_string(id) + ", which hung on it at a place that nobody knows without it";
  return text;
}

std::size_t KnownFronts::follow(std::vector<TrackUpdate> updates) {
  tracks_.add(std::move(updates));
  for (const Track& track : tracks_.ended()) ended_[track.id] = track;
  return tracks_.waiting();
}

void KnownFronts::update(const std::vector<LearnedModel>& models) {
  std::map<std::uint32_t, LearnedModel> seen;
  for (const LearnedModel& model : models) seen[model.id] = model;
  live_.swap(seen);
  for (auto& [id, model] : live_) model.name = nameGiven(id);
  for (const auto& [id, before] : seen) {
    const auto now = live_.find(id);
    const bool still_told = now != live_.end() && isWorthKeeping(now->second);
    if (!isWorthKeeping(before) || still_told) continue;
    const Track* track = trackOf(id);
    remember({before, track != nullptr ? *track : Track()});
  }
  ended_.clear();
  for (const auto& [id, model] : live_) {
    const auto known = remembered_.find(id);
    if (known == remembered_.end()) continue;
    if (isWorthKeeping(model))
      remembered_.erase(known);
    else if (isGivenUp(model))
      known->second.model.doubt = model.doubt;
  }
}

const Track* KnownFronts::trackOf(std::uint32_t id) const {
  if (const Track* live = findTrack(id, tracks_.tracks())) return live;
  const auto ended = ended_.find(id);
  return ended == ended_.end() ? nullptr : &ended->second;
}

void KnownFronts::remember(KnownFront front) {
  while (thinOut(front.track.observations, kKeptObservations)) ++front.track.revision;
  const std::uint32_t id = front.model.id;
  remembered_[id] = std::move(front);
  if (remembered_.size() <= kMostRemembered) return;
  std::set<std::uint32_t> parents;
  for (const LearnedModel& model : allModels()) parents.insert(model.parent);
  remembered_.erase(std::min_element(remembered_.begin(), remembered_.end(), [&](const auto& a, const auto& b) {
    const auto worth = [&](const LearnedModel& model) {
      return std::make_tuple(parents.count(model.id) > 0, !model.name.empty(), model.observations);
    };
    return worth(a.second.model) < worth(b.second.model);
  }));
}

std::string KnownFronts::nameGiven(std::uint32_t id) const {
  const auto name = names_.find(id);
  return name == names_.end() ? "" : name->second;
}

void KnownFronts::giveNames(std::vector<LearnedModel>* models) const {
  for (LearnedModel& model : *models) model.name = nameGiven(model.id);
}

std::string KnownFronts::whyNotNamed(std::uint32_t id, const std::string& name, const std::string& reserved) const {
  const std::string unfit = whyUnfit(name);
  if (!unfit.empty()) return unfit;
  const std::optional<std::uint32_t> owner = ownerOfDefaultName(name);
  if (owner && *owner != id) return "'" + name + "' is what front " + std::to_string(*owner) + " is called without a name";
  if (name == reserved) return "'" + name + "' would be the name of the frame that all models are in";
  for (const auto& [other, taken] : names_)
    if (other != id && taken == name && isKnown(other)) return "'" + name + "' is the name of front " + std::to_string(other);
  return "";
}

void KnownFronts::dropNamesOfUnknown(const std::string& name) {
  const bool too_many = names_.size() > kMostNames;
  for (auto entry = names_.begin(); entry != names_.end();)
    entry = !isKnown(entry->first) && (too_many || entry->second == name) ? names_.erase(entry) : std::next(entry);
}

void KnownFronts::setName(std::uint32_t id, const std::string& name, const std::string& reserved) {
  at(id);
  const std::string why_not = whyNotNamed(id, name, reserved);
  const auto is_free = [&](const std::string& other) { return whyNotNamed(id, other, reserved).empty(); };
  if (!why_not.empty()) throw NameError(why_not, proposeName(name, id, is_free));
  dropNamesOfUnknown(name);
  names_[id] = name;
  const auto live = live_.find(id);
  if (live != live_.end()) live->second.name = name;
  const auto known = remembered_.find(id);
  if (known != remembered_.end()) known->second.model.name = name;
}

const LearnedModel& KnownFronts::at(std::uint32_t id) const {
  const auto known = remembered_.find(id);
  const auto live = live_.find(id);
  // A front that came back may have to move again before its own model tells more than the remembered one.
  const bool live_tells_more =
      known == remembered_.end() || (isGivenUp(known->second.model) && live != live_.end() && isJoint(live->second));
  if (!live_tells_more) return known->second.model;
  if (live != live_.end()) return live->second;
  std::set<std::uint32_t> ids;
  for (const auto& entry : live_) ids.insert(entry.first);
  for (const auto& entry : remembered_) ids.insert(entry.first);
  std::string others;
  for (const std::uint32_t other : ids) others += (others.empty() ? "" : ", ") + std::to_string(other);
  throw ModelError(
      "there is no front " + std::to_string(id) +
      (others.empty()
           ? "; none was seen yet (the pipeline only works while somebody subscribes to its models, or with lazy: false)"
           : "; the fronts known are " + others));
}

auto KnownFronts::worthKeeping() const -> std::map<std::uint32_t, Kept> {
  std::map<std::uint32_t, Kept> all;
  for (const auto& [id, front] : remembered_) all[id] = {&front.model, &front.track};
  for (const auto& [id, model] : live_)
    if (isWorthKeeping(model)) all[id] = {&model, trackOf(id)};
  return all;
}

std::vector<KnownFront> KnownFronts::joints() const {
  std::vector<KnownFront> result;
  for (const auto& [id, kept] : worthKeeping()) result.push_back({*kept.model, kept.track != nullptr ? *kept.track : Track()});
  return result;
}

std::vector<LearnedModel> KnownFronts::jointModels() const {
  std::vector<LearnedModel> result;
  for (const auto& entry : worthKeeping()) result.push_back(*entry.second.model);
  return result;
}

void KnownFronts::replace(std::vector<KnownFront> fronts) {
  tracks_.clear();
  ended_.clear();
  live_.clear();
  remembered_.clear();
  names_.clear();
  for (const KnownFront& front : fronts)
    if (!front.model.name.empty()) names_[front.model.id] = front.model.name;
  for (KnownFront& front : fronts) remember(std::move(front));
}

/// Of every id what at() says.
std::vector<LearnedModel> KnownFronts::allModels() const {
  std::vector<LearnedModel> all;
  for (const auto& entry : remembered_) all.push_back(at(entry.first));
  for (const auto& entry : live_)
    if (remembered_.count(entry.first) == 0) all.push_back(entry.second);
  return all;
}

void KnownFronts::setDownChildren(const std::vector<LearnedModel>& all, ForgottenFront* forgotten) {
  for (const LearnedModel& child : all) {
    if (child.parent != forgotten->model.id) continue;
    const bool has_place = hangsOnKnown(child, all);
    (has_place ? forgotten->set_down : forgotten->lost).push_back(child.id);
    const auto live = live_.find(child.id);
    const auto known = remembered_.find(child.id);
    if (live != live_.end() && live->second.parent == forgotten->model.id) {
      if (has_place)
        live->second = setDown(live->second, all);
      else
        live_.erase(live);
    }
    if (known == remembered_.end() || known->second.model.parent != forgotten->model.id) continue;
    if (has_place)
      known->second.model = setDown(known->second.model, all);
    else
      remembered_.erase(known);
  }
}

ForgottenFront KnownFronts::forget(std::uint32_t id) {
  ForgottenFront forgotten(at(id));
  const std::vector<LearnedModel> all = allModels();
  setDownChildren(all, &forgotten);
  const LearnedModel* parent = findModel(forgotten.model.parent, all);
  if (parent != nullptr && hangsOnKnown(forgotten.model, all)) {
    const LearnedModel in_world = placed(*parent, all);
    forgotten.parent = frontAt(in_world, in_world.q);
    forgotten.model = placed(forgotten.model, all);
  }
  live_.erase(id);
  remembered_.erase(id);
  names_.erase(id);
  return forgotten;
}

}  // namespace cabinet_articulation::core
