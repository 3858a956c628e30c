// SPDX-License-Identifier: BSD-3-Clause
#include "kinds/kind_memory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "kinds/upright.h"

namespace cabinet_articulation::core {
namespace {

bool isAtRest(const LearnedModel& model) { return !model.moved && model.type == JointType::kRigid && model.doubt == 0; }

/// Whether the size of the front was seen, not merely its part.
bool isSeenWhole(const Track& track, double edge_support_min) {
  std::array<double, 4> sums{};
  for (const TrackedObservation& observation : track.observations)
    for (std::size_t edge = 0; edge < sums.size(); ++edge) sums[edge] += observation.edge_support[edge];
  const double least = edge_support_min * static_cast<double>(track.observations.size());
  return !track.observations.empty() && std::all_of(sums.begin(), sums.end(), [least](double sum) { return sum >= least; });
}

/// The answer that `ask` gives for the upright front, for the front as it is described.
template <class Ask>
LearnedModel askedUpright(const LearnedModel& front, const Ask& ask) {
  const int k = uprightDescription(front.origin.linear());
  LearnedModel upright = front;
  upright.origin.linear() = front.origin.linear() * turnOf(k);
  if (k % 2 != 0) std::swap(upright.width, upright.height);
  LearnedModel answer = ask(upright);
  answer.origin = front.origin;
  answer.width = front.width;
  answer.height = front.height;
  return answer;
}

}  // namespace

KindMemory::KindMemory(const LearningConfig& config) : config_(config), kinds_(config.kinds, config.articulation.prior) {}

void KindMemory::configure(const LearningConfig& config) {
  const std::vector<JointShape> votes = kinds_.shapes();
  config_ = config;
  kinds_ = JointKinds(config.kinds, config.articulation.prior);
  for (const JointShape& vote : votes) kinds_.add(vote);
}

bool KindMemory::isExact(const LearnedModel& model) const {
  if (!model.moved || !model.explained || model.support == 0 || !hasShape(model)) return false;
  if (model.probabilities.at(static_cast<std::size_t>(model.type)) < kSureOfType || model.covariance.isZero()) return false;
  const ShapeSigmas sigmas = shapeSigmas(model);
  return sigmas.turn <= config_.kinds.turn_spread && sigmas.radius <= config_.kinds.radius_spread;
}

void KindMemory::learnFrom(const LearnedModel& model) {
  if (model.doubt >= 1 || model.parent != 0) return kinds_.remove(model.id);
  if (model.doubt > 0 || !isExact(model)) return;
  const JointShape vote = described(shapeOf(model, model.origin.linear()), uprightDescription(model.origin.linear()));
  if (!kinds_.holds(vote)) kinds_.add(vote);
}

/// The answer of all kinds, without what the front itself taught.
template <class Ask>
LearnedModel KindMemory::askOthers(const LearnedModel& front, const Ask& ask) const {
  const auto answer = [&](const JointKinds& kinds) {
    return askedUpright(front, [&](const LearnedModel& upright) { return ask(kinds, upright); });
  };
  return kinds_.jointOf(front.id) ? answer(kinds_.without(front.id)) : answer(kinds_);
}

LearnedModel KindMemory::told(const LearnedModel& model) const {
  if (!config_.kinds.kinds || kinds().empty() || model.parent != 0) return model;
  if (!model.moved || !model.explained || model.doubt > 0 || !hasShape(model) || isExact(model)) return model;
  return askOthers(model, [](const JointKinds& others, const LearnedModel& upright) { return others.update(upright); });
}

void KindMemory::complete(const std::vector<Track>& tracks, std::vector<LearnedModel>* models) {
  if (!config_.kinds.kinds) return;
  for (const LearnedModel& model : *models) learnFrom(model);
  if (kinds().empty()) return;
  const auto at_rest = static_cast<std::size_t>(std::count_if(models->begin(), models->end(), isAtRest));
  const auto expect = [at_rest](const JointKinds& others, const LearnedModel& front) { return others.expect(front, at_rest); };
  for (LearnedModel& model : *models) {
    const Track* track = findTrack(model.id, tracks);
    if (!isAtRest(model))
      model = told(model);
    else if (track != nullptr && isSeenWhole(*track, config_.articulation.edge_support_min))
      model = askOthers(model, expect);
  }
}

void KindMemory::startFrom(const std::vector<JointShape>& past, const std::vector<LearnedModel>& fronts) {
  *this = KindMemory(config_);
  for (JointShape vote : past) {
    vote.front = 0;
    kinds_.add(vote);
  }
  for (const LearnedModel& front : fronts) learnFrom(front);
}

void KindMemory::keepFronts(const std::vector<LearnedModel>& fronts) {
  std::set<std::uint32_t> ids;
  for (const LearnedModel& front : fronts) ids.insert(front.id);
  for (const JointShape& vote : kinds_.shapes())
    if (vote.front != 0 && ids.count(vote.front) == 0) forget(vote.front);
}

void KindMemory::forget(std::uint32_t front) { kinds_.disown(front); }

std::vector<JointShape> KindMemory::votesOf(std::uint32_t front) const {
  const std::optional<JointShape> vote = kinds_.jointOf(front);
  return vote ? std::vector<JointShape>{*vote} : std::vector<JointShape>();
}

std::vector<JointShape> KindMemory::votesBeside(const std::set<std::uint32_t>& fronts) const {
  std::vector<JointShape> votes;
  for (const JointShape& vote : kinds_.shapes())
    if (fronts.count(vote.front) == 0) votes.push_back(vote);
  return votes;
}

}  // namespace cabinet_articulation::core
