// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/articulation_learner.h"

#include <algorithm>
#include <map>
#include <utility>

#include "articulation/learner/front_learner.h"
#include "articulation/models/model_registry.h"

namespace cabinet_articulation::core {
namespace {

constexpr std::size_t kMostAbsent = 1000;  ///< joints out of view that stay known, some 2 kB each (ours: a large building)

}  // namespace

struct ArticulationLearner::State {
  struct Entry {
    explicit Entry(const ArticulationConfig& config) : learner(config) {}
    void update(const Track& track);

    FrontLearner learner;
    std::size_t observations = 0;
    double stamp = 0, width = 0, height = 0;
    bool learned = false;
  };
  using Entries = std::map<std::uint32_t, Entry>;

  Entries::iterator enter(std::uint32_t id, const ArticulationConfig& config, Entries* live);
  void keep(const LearnedModel& model);

  Entries entries;
  std::map<std::uint32_t, LearnedModel> absent;  ///< joints whose tracks are not given at present
};

void ArticulationLearner::State::Entry::update(const Track& track) {
  if (track.observations.empty()) return;
  const double newest = track.observations.back().stamp;
  if (observations == track.observations.size() && stamp == newest && width == track.width && height == track.height) return;
  learned = learner.update(track) || learned;
  observations = track.observations.size();
  stamp = newest;
  width = track.width;
  height = track.height;
}

/// Moves what is known of the front from `entries` or `absent` to `live`.
auto ArticulationLearner::State::enter(std::uint32_t id, const ArticulationConfig& config, Entries* live) -> Entries::iterator {
  auto node = entries.extract(id);
  if (!node.empty()) return live->insert(std::move(node)).position;
  const auto entry = live->emplace(id, config).first;
  const auto known = absent.find(id);
  if (known == absent.end()) return entry;
  entry->second.learner.remember(known->second);
  absent.erase(known);
  return entry;
}

/// Also that a joint was given up: the observations that it came from are not to be believed again.
void ArticulationLearner::State::keep(const LearnedModel& model) {
  absent[model.id] = model;
  if (absent.size() <= kMostAbsent) return;
  const auto earlier = [](const auto& a, const auto& b) { return a.second.stamp < b.second.stamp; };
  absent.erase(std::min_element(absent.begin(), absent.end(), earlier));
}

ArticulationLearner::ArticulationLearner(const ArticulationConfig& config) : config_(config), state_(std::make_unique<State>()) {
  checkConfig(config);
  chosenModels(config);  // throws for a wrong name now, not at the first front
}

ArticulationLearner::~ArticulationLearner() = default;

void ArticulationLearner::remember(const std::vector<LearnedModel>& joints) {
  for (const LearnedModel& joint : joints) {
    state_->entries.erase(joint.id);
    state_->keep(joint);
  }
}

void ArticulationLearner::forget(std::uint32_t id) {
  state_->entries.erase(id);
  state_->absent.erase(id);
}

void ArticulationLearner::reset() { *state_ = State(); }

std::vector<LearnedModel> ArticulationLearner::process(const std::vector<Track>& tracks) {
  State::Entries live;
  for (const Track& track : tracks) state_->enter(track.id, config_, &live)->second.update(track);
  for (const auto& [id, gone] : state_->entries)
    if (gone.learner.knowsJoint() || gone.learner.best().doubt > 0) state_->keep(gone.learner.best());
  state_->entries = std::move(live);
  std::vector<LearnedModel> models;
  for (const auto& [id, entry] : state_->entries)
    if (entry.learned) models.push_back(entry.learner.best());
  return models;
}

std::vector<LearnedModel> fitAllModels(const Track& track, const ArticulationConfig& config) {
  FrontLearner learner(config);
  return learner.update(track) ? learner.candidates() : std::vector<LearnedModel>{};
}

}  // namespace cabinet_articulation::core
