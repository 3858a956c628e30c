// SPDX-License-Identifier: BSD-3-Clause
#include "joints/front_merge.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "cabinet_articulation/joints/hanging.h"
#include "cabinet_articulation/joints/joint.h"
#include "joints/front_names.h"

namespace cabinet_articulation::core {
namespace {

// Identity of a history's first observation, which is never thinned out, but placed anew when the size is known better.
constexpr double kSameStamp = 1e-5;  // [s]
constexpr double kSamePoint = 0.05;  // [m]

/// Whether `known` was learned from the file's observations, too.
bool continues(const KnownFront& known, const KnownFront& file) {
  const auto &now = known.track.observations, &before = file.track.observations;
  if (now.empty() || before.empty()) return false;
  return std::abs(now.front().stamp - before.front().stamp) < kSameStamp &&
         (now.front().rectangle.center() - before.front().rectangle.center()).norm() < kSamePoint &&
         now.back().stamp > before.back().stamp - kSameStamp;
}

/// It is the file's front, which was found to hang on another one since.
bool hangsElsewhereNow(const KnownFront& known, const KnownFront& file) {
  return known.model.parent != file.model.parent && continues(known, file);
}

bool isMuchPoorer(const KnownFront& known, const KnownFront& file) {
  if (continues(known, file)) return false;
  if (isGivenUp(known.model) != isGivenUp(file.model)) return isGivenUp(known.model);
  return 2 * std::min(known.model.observations, kKeptObservations) < std::min(file.model.observations, kKeptObservations);
}

/// "front_5" is no name for another front than 5.
void setName(const std::string& name, KnownFront* front) {
  const std::optional<std::uint32_t> owner = ownerOfDefaultName(name);
  front->model.name = !owner || *owner == front->model.id ? name : "";
}

void setId(std::uint32_t id, KnownFront* front) {
  front->model.id = front->track.id = id;
  setName(front->model.name, front);
}

/// Gives other names to fronts whose names are taken by those that `come_first`, or by fronts before them.
std::vector<NameChange> makeNamesUnique(std::vector<KnownFront>* fronts, const std::set<std::uint32_t>& come_first) {
  std::set<std::string> taken, all;
  for (const KnownFront& front : *fronts) {
    all.insert(front.model.name);
    if (come_first.count(front.model.id) > 0) taken.insert(front.model.name);
  }
  const auto is_free = [&](const std::string& name) { return all.count(name) == 0 && !ownerOfDefaultName(name); };
  std::vector<NameChange> changes;
  for (KnownFront& front : *fronts) {
    const std::string name = front.model.name;
    if (name.empty() || come_first.count(front.model.id) > 0 || taken.insert(name).second) continue;
    front.model.name = proposeName(name, front.model.id, is_free);
    all.insert(front.model.name);
    changes.push_back({front.model.id, name, front.model.name});
  }
  return changes;
}

/// The file's front as it is described if it hangs on what the known one hangs on.
LearnedModel onParentOf(const LearnedModel& known, const LearnedModel& file, const std::vector<LearnedModel>& all_known,
                        const std::vector<LearnedModel>& all_file) {
  const LearnedModel *now = findModel(known.parent, all_known), *before = findModel(file.parent, all_file);
  return now != nullptr && before != nullptr ? transformed(file, turnBetween(*now, *before)) : file;
}

/// For every known front the file's one of the same place, or -1; the nearest pairs first, and those of one id before.
std::vector<int> pairUp(const std::vector<KnownFront>& known, const std::vector<KnownFront>& file) {
  const std::vector<LearnedModel> all_known = modelsOf(known), all_file = modelsOf(file);
  const auto distanceOf = [&](std::size_t i, std::size_t j) {
    return samePlace(known[i].model, onParentOf(known[i].model, file[j].model, all_known, all_file));
  };
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < known.size(); ++i)
    for (std::size_t j = 0; j < file.size(); ++j) {
      const std::optional<double> distance = hangsElsewhereNow(known[i], file[j]) ? std::optional<double>(0) : distanceOf(i, j);
      if (distance) pairs.emplace_back(known[i].model.id == file[j].model.id ? -1 : *distance, i, j);
    }
  // Parents come before what hangs on them.
  std::stable_sort(pairs.begin(), pairs.end());
  std::stable_partition(pairs.begin(), pairs.end(), [&](const auto& pair) { return known[std::get<1>(pair)].model.parent == 0; });
  std::vector<int> partner(known.size(), -1);
  std::vector<bool> taken(file.size(), false);
  const auto have_one_parent = [&](const LearnedModel& now, const LearnedModel& before) {
    for (std::size_t i = 0; i < known.size(); ++i)
      if (known[i].model.id == now.parent)
        return partner[i] >= 0 && file[static_cast<std::size_t>(partner[i])].model.id == before.parent;
    return false;
  };
  for (const auto& [distance, i, j] : pairs) {
    const bool comparable = known[i].model.parent == 0 || file[j].model.parent == 0 || hangsElsewhereNow(known[i], file[j]);
    if (partner[i] >= 0 || taken[j] || !(comparable || have_one_parent(known[i].model, file[j].model))) continue;
    partner[i] = static_cast<int>(j);
    taken[j] = true;
  }
  return partner;
}

/// Nobody could place it.
void removeWhatHangsOnNothing(std::vector<KnownFront>* fronts) {
  const auto has_no_parent = [&](const KnownFront& front) {
    const auto is_parent = [&](const KnownFront& other) { return other.model.id == front.model.parent; };
    return front.model.parent != 0 && std::none_of(fronts->begin(), fronts->end(), is_parent);
  };
  for (std::size_t before = fronts->size() + 1; before > fronts->size();) {
    before = fronts->size();
    std::vector<KnownFront> left;
    std::remove_copy_if(fronts->begin(), fronts->end(), std::back_inserter(left), has_no_parent);
    fronts->swap(left);
  }
}

void turnChildren(std::uint32_t parent, const Eigen::Isometry3d& T_target_source, std::vector<KnownFront>* fronts) {
  for (KnownFront& front : *fronts)
    if (front.model.parent == parent) front.model = transformed(front.model, T_target_source);
}

using NewIds = std::map<std::uint32_t, std::uint32_t>;  ///< of the file's fronts

/// Leaves the better known one of each pair in `known`, with the id of the other. Returns how many are those of the file.
std::size_t joinPairs(const std::vector<int>& partner, std::vector<KnownFront>* known, std::vector<KnownFront>* file,
                      NewIds* new_ids) {
  std::size_t from_file = 0;
  std::vector<std::size_t> order(known->size());
  std::iota(order.begin(), order.end(), 0U);
  // What turns with its parent must still be where that is.
  std::stable_partition(order.begin(), order.end(), [&](std::size_t i) { return (*known)[i].model.parent == 0; });
  for (const std::size_t i : order) {
    if (partner[i] < 0) continue;
    KnownFront &front = (*known)[i], &other = (*file)[static_cast<std::size_t>(partner[i])];
    const LearnedModel now = front.model;
    (*new_ids)[other.model.id] = now.id;
    const std::string name = now.name.empty() ? other.model.name : now.name;
    const Eigen::Isometry3d T_known_file = turnBetween(front.model, other.model);
    if (isMuchPoorer(front, other)) {
      turnChildren(now.id, T_known_file.inverse(), known);
      front = std::move(other);
      setId(now.id, &front);
      front.model.parent = now.parent;
      ++from_file;
    } else {
      turnChildren(other.model.id, T_known_file, file);
    }
    setName(name, &front);
  }
  return from_file;
}

std::set<std::uint32_t> idsOfNamed(const std::vector<KnownFront>& fronts) {
  std::set<std::uint32_t> ids;
  for (const KnownFront& front : fronts)
    if (!front.model.name.empty()) ids.insert(front.model.id);
  return ids;
}

}  // namespace

std::vector<IdChange> giveFreeIds(std::vector<KnownFront>* fronts, std::vector<std::uint32_t>* taken) {
  std::set<std::uint32_t> ids(taken->begin(), taken->end());
  std::vector<KnownFront*> without;
  for (KnownFront& front : *fronts)
    if (front.model.id == 0 || front.model.id > kLargestId || !ids.insert(front.model.id).second) without.push_back(&front);
  std::vector<IdChange> changes;
  for (KnownFront* front : without) {
    std::uint32_t id = ids.empty() ? 1 : *ids.rbegin() + 1;
    if (id > kLargestId)
      for (id = 1; ids.count(id) > 0;) ++id;
    changes.push_back({front->model.id, id});
    setId(id, front);
    ids.insert(id);
  }
  taken->assign(ids.begin(), ids.end());
  return changes;
}

MergedFronts mergeFronts(std::vector<KnownFront> known, std::vector<KnownFront> file,
                         const std::vector<ForgottenFront>& removed) {
  const std::vector<LearnedModel> in_file = modelsOf(file);
  const auto is_removed = [&](const KnownFront& front) {
    return std::any_of(removed.begin(), removed.end(),
                       [&](const ForgottenFront& forgotten) { return isSameFront(forgotten, front.model, in_file); });
  };
  file.erase(std::remove_if(file.begin(), file.end(), is_removed), file.end());
  removeWhatHangsOnNothing(&file);
  MergedFronts merged;
  std::vector<std::uint32_t> taken;
  merged.known_changes = giveFreeIds(&known, &taken);
  const std::vector<int> partner = pairUp(known, file);
  std::vector<bool> paired(file.size(), false);
  const std::set<std::uint32_t> named_now = idsOfNamed(known);
  NewIds new_ids;
  for (const KnownFront& front : file) new_ids[front.model.id] = front.model.id;
  merged.from_file = joinPairs(partner, &known, &file, &new_ids);
  for (const int index : partner)
    if (index >= 0) paired[static_cast<std::size_t>(index)] = true;
  std::vector<KnownFront> others;
  for (std::size_t j = 0; j < file.size(); ++j)
    if (!paired[j]) others.push_back(std::move(file[j]));
  merged.changes = giveFreeIds(&others, &taken);
  for (const IdChange& change : merged.changes) new_ids[change.from] = change.to;
  for (KnownFront& front : others)
    if (front.model.parent != 0) front.model.parent = new_ids.at(front.model.parent);
  merged.from_file += others.size();
  merged.fronts = std::move(known);
  std::move(others.begin(), others.end(), std::back_inserter(merged.fronts));
  removeWhatHangsOnNothing(&merged.fronts);
  std::sort(merged.fronts.begin(), merged.fronts.end(),
            [](const KnownFront& a, const KnownFront& b) { return a.model.id < b.model.id; });
  merged.renamed = makeNamesUnique(&merged.fronts, named_now);
  return merged;
}

}  // namespace cabinet_articulation::core
