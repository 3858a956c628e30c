// SPDX-License-Identifier: BSD-3-Clause
#include "joints/removed_fronts.h"

#include <algorithm>
#include <filesystem>

#include "joints/front_place.h"

namespace cabinet_articulation::core {
namespace {

std::string nameOf(const std::string& file) {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::weakly_canonical(file, error);
  return error ? file : path.string();
}

bool isAmong(const ForgottenFront& forgotten, const std::vector<LearnedModel>& models) {
  return std::any_of(models.begin(), models.end(),
                     [&](const LearnedModel& model) { return isSameFront(forgotten, model, models); });
}

}  // namespace

void RemovedFronts::add(const ForgottenFront& forgotten) {
  if (forgotten.model.parent != 0 && !forgotten.parent) return;
  places_.push_back({forgotten, {}});
  if (places_.size() > kMost) places_.pop_front();
}

std::vector<ForgottenFront> RemovedFronts::in(const std::string& file) const {
  const std::string name = nameOf(file);
  std::vector<ForgottenFront> fronts;
  for (const Place& place : places_)
    if (place.free_in.count(name) == 0) fronts.push_back(place.front);
  return fronts;
}

void RemovedFronts::saved(const std::string& file, const std::vector<KnownFront>& fronts) {
  const std::string name = nameOf(file);
  const std::vector<LearnedModel> models = modelsOf(fronts);
  for (Place& place : places_)
    if (isAmong(place.front, models)) place.free_in.insert(name);
}

void RemovedFronts::loaded(const std::vector<KnownFront>& fronts) {
  const std::vector<LearnedModel> models = modelsOf(fronts);
  const auto known_again = [&](const Place& place) { return isAmong(place.front, models); };
  places_.erase(std::remove_if(places_.begin(), places_.end(), known_again), places_.end());
}

}  // namespace cabinet_articulation::core
