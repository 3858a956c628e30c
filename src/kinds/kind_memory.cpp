// SPDX-License-Identifier: BSD-3-Clause
#include "kinds/kind_memory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "kinds/upright.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kSureOfType = 0.95;  ///< a joint that is told by less teaches nothing (ours)

bool isAtRest(const LearnedModel& model) { return !model.moved && model.type == JointType::kRigid && model.doubt == 0; }

/// Whether the size of the front was seen, not merely its part.
bool isSeenWhole(const Track& track, double edge_support_min) {
  std::array<double, 4> sums{};
  for (const TrackedObservation& observation : track.observations)
    for (std::size_t edge = 0; edge < sums.size(); ++edge) sums[edge] += observation.edge_support[edge];
  const double least = edge_support_min * static_cast<double>(track.observations.size());
  return std::all_of(sums.begin(), sums.end(), [least](double sum) { return sum >= least; });
}

/// What was told of a front, where the front is now.
LearnedModel continued(const LearnedModel& told, const LearnedModel& learned, const Track& track) {
  LearnedModel model = learned;
  model.type = told.type;
  model.probabilities = told.probabilities;
  model.origin = told.origin;
  model.axis = told.axis;
  model.axis_point = told.axis_point;
  model.radius = told.radius;
  model.params = told.params;
  model.q = told.configuration(track.observations.back().rectangle.pose);
  model.q_min = std::min(told.q_min, model.q);
  model.q_max = std::max(told.q_max, model.q);
  model.q_min_is_end = model.q_max_is_end = false;
  return model;
}

const Track* trackOf(std::uint32_t id, const std::vector<Track>& tracks) {
  const auto found = std::find_if(tracks.begin(), tracks.end(), [id](const Track& track) { return track.id == id; });
  return found == tracks.end() || found->observations.empty() ? nullptr : &*found;
}

}  // namespace

KindMemory::KindMemory(const LearningConfig& config) : config_(config), kinds_(config.kinds, config.articulation.prior) {}

void KindMemory::configure(const LearningConfig& config) {
  const std::vector<JointShape> votes = kinds_.shapes();
  config_ = config;
  kinds_ = JointKinds(config.kinds, config.articulation.prior);
  for (const JointShape& vote : votes) kinds_.add(vote);
  told_.clear();
}

bool KindMemory::isExact(const LearnedModel& model) const {
  if (!model.moved || !model.explained || model.support == 0 || !hasShape(model)) return false;
  if (model.probabilities.at(static_cast<std::size_t>(model.type)) < kSureOfType || model.covariance.isZero()) return false;
  const ShapeSigmas sigmas = shapeSigmas(model);
  return sigmas.turn <= config_.kinds.turn_spread && sigmas.radius <= config_.kinds.radius_spread;
}

void KindMemory::learnFrom(const LearnedModel& model) {
  if (model.doubt >= 1) return kinds_.remove(model.id);
  if (model.doubt > 0 || !isExact(model)) return;
  const JointShape vote = described(shapeOf(model, model.origin.linear()), uprightDescription(model.origin.linear()));
  if (!kinds_.holds(vote)) kinds_.add(vote);
}

LearnedModel KindMemory::tell(const LearnedModel& learned, const Track& track) {
  constexpr double kGrowth = 1.1;  // a fit takes milliseconds, and a tenth more poses tell little more (ours)
  Told& told = told_[learned.id];
  const std::size_t observations = track.observations.size();
  const bool is_due = told.observations == 0 || observations < told.observations ||
                      static_cast<double>(observations) >= kGrowth * static_cast<double>(told.observations);
  if (!is_due) return told.model.moved ? continued(told.model, learned, track) : learned;
  const JointKinds others = kinds_.toldTo(learned.id, uprightDescription(learned.origin.linear()));
  const LearnedModel model = others.predict(learned, track, config_.articulation);
  told.observations = observations;
  told.model = model;
  // Told nothing: the next frames are as learned, too.
  if (model.origin.matrix() == learned.origin.matrix() && model.axis == learned.axis) told.model.moved = false;
  return model;
}

void KindMemory::complete(const std::vector<Track>& tracks, std::vector<LearnedModel>* models) {
  if (!config_.kinds.kinds) return;
  for (const LearnedModel& model : *models) learnFrom(model);
  std::map<std::uint32_t, Told> before;
  before.swap(told_);
  if (kinds().empty()) return;
  const auto at_rest = static_cast<std::size_t>(std::count_if(models->begin(), models->end(), isAtRest));
  for (LearnedModel& model : *models) {
    const Track* track = trackOf(model.id, tracks);
    if (track == nullptr) continue;
    if (isAtRest(model) && isSeenWhole(*track, config_.articulation.edge_support_min))
      model = kinds_.toldTo(model.id, uprightDescription(model.origin.linear())).expect(model, at_rest);
    if (!model.moved || !model.explained || !hasShape(model) || isExact(model)) continue;
    const auto told = before.find(model.id);
    if (told != before.end()) told_.insert(*told);
    model = tell(model, *track);
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

void KindMemory::forget(std::uint32_t front) {
  kinds_.disown(front);
  told_.erase(front);
}

std::vector<JointShape> KindMemory::votesBeside(const std::set<std::uint32_t>& fronts) const {
  std::vector<JointShape> votes;
  for (const JointShape& vote : kinds_.shapes())
    if (fronts.count(vote.front) == 0) votes.push_back(vote);
  return votes;
}

}  // namespace cabinet_articulation::core
