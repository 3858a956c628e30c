// SPDX-License-Identifier: BSD-3-Clause
#include "closing/closed_finder.h"

#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include "cabinet_articulation/joints/joint.h"
#include "closing/closed_place.h"
#include "closing/closed_search.h"

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
    places_[joint.id] = {true, frontAt(joint, joint.q_closed), 0};
  }
}

/// The joint that waited longest; those whose place is unknown first.
void ClosedFinder::searchOne(const std::vector<LearnedModel>& models) {
  const LearnedModel* next = nullptr;
  std::pair<bool, std::uint64_t> urgency;
  for (const LearnedModel& model : models) {
    if (!canBeSearched(model)) continue;
    const Place& place = places_[model.id];
    const std::pair<bool, std::uint64_t> waiting(place.known, place.searched_at);
    if (next != nullptr && waiting >= urgency) continue;
    next = &model;
    urgency = waiting;
  }
  if (next == nullptr) return;
  Place& place = places_[next->id];
  place.searched_at = frame_;
  const std::optional<Rectangle> closed = findClosed(*next, memory_.views());
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
  ++frame_;
  forgetOthers(*models);
  searchOne(*models);
  for (LearnedModel& model : *models) {
    const auto place = places_.find(model.id);
    if (place == places_.end() || !place->second.known || !canBeSearched(model)) {
      setClosed(false, 0, &model);
      continue;
    }
    const double q_closed = configurationInPlaneOf(place->second.closed, model);
    // It was seen farther in.
    if (!opensOutwardsFrom(model, q_closed)) places_.erase(place);
    setClosed(opensOutwardsFrom(model, q_closed), q_closed, &model);
  }
}

}  // namespace cabinet_articulation::core
