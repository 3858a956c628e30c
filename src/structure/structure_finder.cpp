// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/structure/structure_finder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/joints/hanging.h"
#include "cabinet_articulation/joints/joint.h"
#include "structure/front_pairs.h"
#include "structure/hanging_front.h"

namespace cabinet_articulation::core {
namespace {

constexpr std::size_t kMostHanging = 256;  ///< beside those in view, as many as joints that are remembered

}  // namespace

struct StructureFinder::State {
  State(const ArticulationConfig& articulation, const StructureConfig& structure)
      : pairs(articulation, structure), relative(articulation) {}

  std::map<std::uint32_t, HangingFront>::iterator unhang(std::map<std::uint32_t, HangingFront>::iterator front) {
    relative.forget(front->first);
    return hanging.erase(front);
  }

  void unhang(std::uint32_t id) {
    const auto front = hanging.find(id);
    if (front != hanging.end()) unhang(front);
  }

  FrontPairs pairs;
  std::map<std::uint32_t, HangingFront> hanging;  ///< by the child's id
  ArticulationLearner relative;                   ///< of joints in the frames of what they hang on
};

namespace {

bool isParent(std::uint32_t id, const std::map<std::uint32_t, HangingFront>& hanging) {
  return std::any_of(hanging.begin(), hanging.end(), [id](const auto& entry) { return entry.second.parent() == id; });
}

/// What this run's observations made likely they can refute. What an earlier run told outweighs them by its own odds, but by no
/// more than the world is preferred by.
bool isRefuted(const HangingFront& front, const UnlikelyEdge& edge, double hanging_odds) {
  if (front.parent() != edge.parent) return false;
  const double odds = front.probability() / std::max(hanging_odds, 1 - front.probability());
  return edge.was_likely || edge.evidence + std::log(odds) < 0;
}

/// The clearest first. What carries another hangs on the world, so that there is no cycle.
void hangUp(const std::vector<LikelyEdge>& edges, double pause, std::map<std::uint32_t, HangingFront>* hanging) {
  for (const LikelyEdge& edge : edges) {
    const auto known = hanging->find(edge.child);
    if (known != hanging->end()) {
      if (known->second.parent() == edge.parent) known->second.setProbability(edge.probability);
      continue;
    }
    if (hanging->count(edge.parent) > 0 || isParent(edge.child, *hanging)) continue;
    hanging->emplace(edge.child, HangingFront(edge.parent, edge.probability, pause));
  }
}

}  // namespace

StructureFinder::StructureFinder(const ArticulationConfig& config, const StructureConfig& structure)
    : config_(config), structure_(structure), state_(std::make_unique<State>(config, structure)) {
  checkConfig(structure);
}

StructureFinder::~StructureFinder() = default;

void StructureFinder::complete(const std::vector<Track>& tracks, std::vector<LearnedModel>* models) {
  std::map<std::uint32_t, HangingFront>& hanging = state_->hanging;
  if (structure_.hanging) state_->pairs.update(tracks, *models);
  if (const std::optional<UnlikelyEdge>& edge = state_->pairs.refuted()) {
    const auto front = hanging.find(edge->child);
    if (front != hanging.end() && isRefuted(front->second, *edge, structure_.hanging_odds)) state_->unhang(front);
  }
  hangUp(state_->pairs.edges(), structure_.pause, &hanging);
  for (auto front = hanging.begin(); hanging.size() > kMostHanging && front != hanging.end();)
    front = findTrack(front->first, tracks) == nullptr ? state_->unhang(front) : std::next(front);
  std::vector<Track> relative;
  for (auto& [id, front] : hanging) {
    const Track *track = findTrack(id, tracks), *carrier = findTrack(front.parent(), tracks);
    const LearnedModel* joint = findModel(front.parent(), *models);
    if (joint != nullptr) front.setPlaceable(isJoint(*joint));
    if (track != nullptr && carrier != nullptr && joint != nullptr) front.follow(*track, *carrier, *joint);
    if (track != nullptr && front.isPlaceable() && !front.seen().observations.empty()) relative.push_back(front.seen());
  }
  for (const LearnedModel& model : state_->relative.process(relative)) hanging.at(model.id).learn(model);
  for (LearnedModel& model : *models) {
    const auto front = hanging.find(model.id);
    if (front == hanging.end()) continue;
    if (isGivenUp(front->second.joint()))
      state_->unhang(front);
    else if (front->second.isPlaceable() && isJoint(front->second.joint()))
      model = front->second.describe(state_->pairs.ratio(model.id, front->second.parent()));
  }
}

void StructureFinder::remember(const std::vector<LearnedModel>& joints) {
  std::vector<LearnedModel> relative;
  for (const LearnedModel& joint : joints) {
    state_->unhang(joint.id);
    if (joint.parent == 0) continue;
    HangingFront front(joint.parent, joint.parent_probability, structure_.pause);
    front.learn(joint);
    state_->hanging.emplace(joint.id, std::move(front));
    relative.push_back(joint);
  }
  state_->relative.remember(relative);
}

void StructureFinder::forget(std::uint32_t id) {
  state_->pairs.forget(id);
  state_->unhang(id);
  for (auto front = state_->hanging.begin(); front != state_->hanging.end();)
    front = front->second.parent() == id ? state_->unhang(front) : std::next(front);
}

void StructureFinder::reset() { state_ = std::make_unique<State>(config_, structure_); }

const std::vector<CoupledFronts>& StructureFinder::coupled() const { return state_->pairs.coupled(); }

}  // namespace cabinet_articulation::core
