// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/articulation_learner.h"

#include <map>

#include "cabinet_articulation/articulation/front_learner.h"

namespace cabinet_articulation::core {

struct ArticulationLearner::State {
  struct Entry {
    explicit Entry(const ArticulationConfig& config) : learner(config) {}
    FrontLearner learner;
    std::size_t observations = 0;
    double stamp = 0, width = 0, height = 0;
    bool learned = false;
  };
  std::map<std::uint32_t, Entry> entries;
};

ArticulationLearner::ArticulationLearner(const ArticulationConfig& config) : config_(config), state_(std::make_unique<State>()) {
  checkConfig(config);
}

ArticulationLearner::~ArticulationLearner() = default;

void ArticulationLearner::remember(const std::vector<LearnedModel>&) {}

void ArticulationLearner::forget(std::uint32_t id) { state_->entries.erase(id); }

void ArticulationLearner::reset() { state_->entries.clear(); }

std::vector<LearnedModel> ArticulationLearner::process(const std::vector<Track>& tracks) {
  std::map<std::uint32_t, State::Entry> live;
  for (const Track& track : tracks) {
    auto node = state_->entries.extract(track.id);
    auto it = node.empty() ? live.emplace(track.id, config_).first : live.insert(std::move(node)).position;
    State::Entry& entry = it->second;
    if (track.observations.empty()) continue;
    const double stamp = track.observations.back().stamp;
    const bool same = entry.observations == track.observations.size() && entry.stamp == stamp && entry.width == track.width &&
                      entry.height == track.height;
    if (same) continue;
    entry.learned = entry.learner.update(track) || entry.learned;
    entry.observations = track.observations.size();
    entry.stamp = stamp;
    entry.width = track.width;
    entry.height = track.height;
  }
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
