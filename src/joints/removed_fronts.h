// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <set>
#include <string>
#include <vector>

#include "cabinet_articulation/joints/known_fronts.h"

namespace cabinet_articulation::core {

/// The places of fronts that were forgotten on purpose, so that they do not come back from a file. A place is free again for a
/// file once another front was saved to it there, and everywhere once a front is loaded there. Files are told apart by their
/// names, links followed.
class RemovedFronts {
 public:
  static constexpr std::size_t kMost = 1024;  ///< beyond, the oldest are dropped (ours)

  /// A front that hung on another one, which is not known, has no place. It leaves a file with its parent.
  void add(const ForgottenFront& forgotten);

  /// Those that must not come back from this file.
  std::vector<ForgottenFront> in(const std::string& file) const;

  /// These were written to the file.
  void saved(const std::string& file, const std::vector<KnownFront>& fronts);

  /// These are known again.
  void loaded(const std::vector<KnownFront>& fronts);

  bool empty() const { return places_.empty(); }
  void clear() { places_.clear(); }

 private:
  struct Place {
    ForgottenFront front;
    std::set<std::string> free_in;
  };
  std::deque<Place> places_;
};

}  // namespace cabinet_articulation::core
