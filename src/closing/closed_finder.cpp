// SPDX-License-Identifier: BSD-3-Clause
#include "closing/closed_finder.h"

#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <tuple>

#include "cabinet_articulation/joints/joint.h"
#include "closing/closed_place.h"
#include "closing/closed_search.h"
#include "geometry/message_precision.h"

namespace cabinet_articulation::core {
namespace {

constexpr std::size_t kMostPlaces = 1000;  ///< as many as joints out of view stay known

bool canBeSearched(const LearnedModel& model) { return isJoint(model) && leavesItsPlane(model); }

void setClosed(bool known, double q_closed, LearnedModel* model) {
  model->closed_known = known;
  model->q_closed = known ? q_closed : std::numeric_limits<double>::quiet_NaN();
  model->opening = openingAt(*model, model->q);
}

}  // namespace

void ClosedFinder::remember(const std::vector<LearnedModel>& joints) {
  for (const LearnedModel& joint : joints) {
    if (!joint.closed_known) continue;
    Place& place = places_[joint.id];
    place.known = true;
    place.closed = frontAt(joint, joint.q_closed);
  }
}

/// Of the joints that were detected in the newest view.
void ClosedFinder::noteEdges(const std::vector<LearnedModel>& models) {
  if (memory_.views().empty()) return;
  const DepthView& view = memory_.views().back();
  for (const LearnedModel& model : models)
    if (canBeSearched(model) && isSameStamp(model.stamp, view.stamp))
      places_[model.id].edges.add(look(view, frontAt(model, model.q), kNeighbourBand));
}

bool ClosedFinder::isDue(const LearnedModel& model, double now) const {
  constexpr double kPeriod = 0.3;  // [s] a front closes in no less
  constexpr double kGrowth = 1.25;
  const auto found = places_.find(model.id);
  if (!canBeSearched(model)) return false;
  if (found == places_.end() || !found->second.searched) return true;
  const Place& place = found->second;
  if (place.known) return model.observations > kGrowth * place.observations;
  return std::abs(now - place.searched_at) > kPeriod;
}

/// Of the joints that are due the one that waited longest; those whose place is unknown first.
void ClosedFinder::searchOne(const std::vector<LearnedModel>& models) {
  if (memory_.views().empty()) return;
  const double now = memory_.views().back().stamp;
  const LearnedModel* next = nullptr;
  std::tuple<bool, bool, double> urgency;
  for (const LearnedModel& model : models) {
    if (!isDue(model, now)) continue;
    const Place& place = places_[model.id];
    const std::tuple<bool, bool, double> waiting(place.known, place.searched, place.searched_at);
    if (next != nullptr && waiting >= urgency) continue;
    next = &model;
    urgency = waiting;
  }
  if (next == nullptr) return;
  Place& place = places_[next->id];
  place.searched = true;
  place.searched_at = now;
  place.observations = next->observations;
  const std::optional<Rectangle> closed = findClosed(*next, place.edges, memory_.views());
  if (!closed) return;
  place.known = true;
  place.closed = *closed;
}

/// What is unknown and out of view is searched for anew when it returns.
void ClosedFinder::forgetOthers(const std::vector<LearnedModel>& models) {
  std::set<std::uint32_t> ids;
  for (const LearnedModel& model : models) ids.insert(model.id);
  for (auto place = places_.begin(); place != places_.end();) {
    const bool absent = ids.count(place->first) == 0;
    const bool forgotten = absent && (!place->second.known || places_.size() > kMostPlaces);
    place = forgotten ? places_.erase(place) : std::next(place);
  }
}

void ClosedFinder::complete(std::vector<LearnedModel>* models) {
  forgetOthers(*models);
  noteEdges(*models);
  searchOne(*models);
  for (LearnedModel& model : *models) {
    const auto place = places_.find(model.id);
    if (place == places_.end() || !place->second.known || !canBeSearched(model)) {
      setClosed(false, 0, &model);
      continue;
    }
    const double q_closed = configurationInPlaneOf(place->second.closed, model);
    const bool still_closed = opensOutwardsFrom(model, q_closed);
    if (!still_closed) places_.erase(place);  // it was seen farther in
    setClosed(still_closed, q_closed, &model);
  }
}

}  // namespace cabinet_articulation::core
