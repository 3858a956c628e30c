// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "cabinet_articulation/joints/known_fronts.h"
#include "joints/front_place.h"

namespace cabinet_articulation::core {

/// A change for every id that is 0, above kLargestId or taken. New ids count on from the largest, or where those are used up
/// (kLargestId), are the first that is free. `taken` grows by all ids.
std::vector<IdChange> giveFreeIds(std::vector<KnownFront>* fronts, std::vector<std::uint32_t>* taken);

/// What is known now and what a file holds, as one.
struct MergedFronts {
  std::vector<KnownFront> fronts;       ///< ordered by id
  std::size_t from_file = 0;            ///< so many of them are as the file has them
  std::vector<IdChange> changes;        ///< of the file's fronts
  std::vector<IdChange> known_changes;  ///< of those known now, whose ids a file cannot hold
  std::vector<NameChange> renamed;      ///< fronts whose names of the file others have now
};

/// Joins both by place. A front that is known now replaces the file's one of the same place. But the file's stays, with the id
/// that the front has now, if it is much better known. Better known is what was learned from more than twice as many observations
/// (counted up to kKeptObservations). So is a joint that was not given up while the other was. What goes on from the file's front
/// itself, as its history tells, always replaces it. Fronts that only the file has stay; `removed` are the places of those that
/// do not. A front without a name keeps the one that the file has for its place. Of fronts that hang on others, those are the
/// same whose parents are, too. What hangs on a front that is removed is removed with it.
MergedFronts mergeFronts(std::vector<KnownFront> known, std::vector<KnownFront> file, const std::vector<ForgottenFront>& removed);

}  // namespace cabinet_articulation::core
