// SPDX-License-Identifier: BSD-3-Clause
#include "closing/closed_finder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include "cabinet_articulation/joints/joint.h"
#include "closing/closed_place.h"
#include "geometry/message_precision.h"

namespace cabinet_articulation::core {
namespace {

constexpr std::size_t kMostPlaces = 1000;  ///< as many as joints out of view stay known
constexpr double kPeriod = 0.3;            ///< [s] a front closes in no less (ours)

bool canBeSearched(const LearnedModel& model) { return isJoint(model) && leavesItsPlane(model); }

void setClosed(bool known, double q_closed, LearnedModel* model) {
  model->closed_known = known;
  model->q_closed = known ? q_closed : std::numeric_limits<double>::quiet_NaN();
  model->opening = openingAt(*model, model->q);
}

/// A front that was seen to be shut has reached its closed position, and is there unless it was detected since. Whether it is.
bool setShut(double shut_at, LearnedModel* model) {
  const bool grows = openEnd(*model, model->q_closed) == model->q_max;
  if (grows && model->q_closed < model->q_min) {
    model->q_min = model->q_closed;
    model->q_min_is_end = true;
  } else if (!grows && model->q_closed > model->q_max) {
    model->q_max = model->q_closed;
    model->q_max_is_end = true;
  }
  if (shut_at <= model->stamp) return false;
  model->q = model->q_closed;
  model->stamp = shut_at;
  model->opening = 0;
  return true;
}

}  // namespace

void ClosedFinder::remember(const std::vector<LearnedModel>& joints) {
  for (const LearnedModel& joint : joints) {
    if (!joint.closed_known) continue;
    Place& place = places_[joint.id];
    place.known = true;
    place.closed.front = frontAt(joint, joint.q_closed);
    place.was_shut = joint.q_min <= joint.q_closed && joint.q_closed <= joint.q_max;
  }
}

/// Of the joints that were detected in the newest view.
void ClosedFinder::noteSightings(const std::vector<LearnedModel>& models) {
  if (memory_.views().empty()) return;
  const DepthView& view = memory_.views().back();
  for (const LearnedModel& model : models) {
    if (!canBeSearched(model) || !isSameStamp(model.stamp, view.stamp)) continue;
    FrontHistory& history = places_[model.id].history;
    std::vector<Sighting>& sightings = history.sightings;
    const auto is_forgotten = [this](const Sighting& sighting) { return !memory_.has(sighting.stamp); };
    sightings.erase(std::remove_if(sightings.begin(), sightings.end(), is_forgotten), sightings.end());
    if (sightings.empty() || !isSameStamp(sightings.back().stamp, view.stamp)) addSighting(model, model.q, view, &history);
  }
}

bool ClosedFinder::isDue(const LearnedModel& model, double now) const {
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
  const std::optional<ClosedPlace> closed = findClosed(*next, place.history, memory_.views());
  if (!closed) return;
  place.known = true;
  place.closed = *closed;
}

/// Looks at the newest view, if the front was not detected there. Views in quick succession may be wrong together, by what passes
/// or by how the light falls. So the front is held for shut or open only once views have said so for a while.
void ClosedFinder::watch(const LearnedModel& model, Place* place) const {
  if (memory_.views().empty()) return;
  const DepthView& view = memory_.views().back();
  if (isSameStamp(model.stamp, view.stamp)) {
    place->shown_shut.reset();
    return;
  }
  if (view.stamp == place->watched_at || view.stamp < model.stamp) return;
  place->watched_at = view.stamp;
  // Of a joint of an earlier run.
  if (!place->closed.turn) place->closed.turn = turnOf(model, place->history.sightings, memory_.views());
  const std::optional<bool> shut = showsShut(model, place->closed.turn, place->history.edges, view);
  if (!shut) return;
  if (place->shown_shut != shut) place->shown_since = view.stamp;
  place->shown_shut = shut;
  if (view.stamp - place->shown_since < kPeriod) return;
  place->shut_at = *shut ? view.stamp : 0;  // 0: it was opened out of sight, nobody knows how far
  place->was_shut = place->was_shut || *shut;
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
  noteSightings(*models);
  searchOne(*models);
  const std::set<std::uint32_t> before = std::exchange(closed_, {});
  for (LearnedModel& model : *models) {
    const auto place = places_.find(model.id);
    if (place == places_.end() || !place->second.known || !canBeSearched(model)) {
      setClosed(false, 0, &model);
      continue;
    }
    const double q_closed = configurationInPlaneOf(place->second.closed.front, model);
    const bool still_closed = opensOutwardsFrom(model, q_closed);
    setClosed(still_closed, q_closed, &model);
    if (!still_closed) {
      places_.erase(place);  // it was seen farther in
      continue;
    }
    watch(model, &place->second);
    if (place->second.was_shut && setShut(place->second.shut_at, &model)) closed_.insert(model.id);
  }
  left_closed_.clear();
  std::set_difference(before.begin(), before.end(), closed_.begin(), closed_.end(),
                      std::inserter(left_closed_, left_closed_.end()));
}

}  // namespace cabinet_articulation::core
