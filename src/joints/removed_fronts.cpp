// SPDX-License-Identifier: BSD-3-Clause
#include "joints/removed_fronts.h"

#include <algorithm>
#include <filesystem>

#include "joints/front_merge.h"

namespace cabinet_articulation::core {
namespace {

std::string nameOf(const std::string& file) {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::weakly_canonical(file, error);
  return error ? file : path.string();
}

bool isAmong(const LearnedModel& model, const std::vector<KnownFront>& fronts) {
  return std::any_of(fronts.begin(), fronts.end(),
                     [&](const KnownFront& front) { return samePlace(model, front.model).has_value(); });
}

}  // namespace

void RemovedFronts::add(const LearnedModel& model) {
  places_.push_back({model, {}});
  if (places_.size() > kMost) places_.pop_front();
}

std::vector<LearnedModel> RemovedFronts::in(const std::string& file) const {
  const std::string name = nameOf(file);
  std::vector<LearnedModel> models;
  for (const Place& place : places_)
    if (place.free_in.count(name) == 0) models.push_back(place.model);
  return models;
}

void RemovedFronts::saved(const std::string& file, const std::vector<KnownFront>& fronts) {
  const std::string name = nameOf(file);
  for (Place& place : places_)
    if (isAmong(place.model, fronts)) place.free_in.insert(name);
}

void RemovedFronts::loaded(const std::vector<KnownFront>& fronts) {
  const auto known_again = [&](const Place& place) { return isAmong(place.model, fronts); };
  places_.erase(std::remove_if(places_.begin(), places_.end(), known_again), places_.end());
}

}  // namespace cabinet_articulation::core
