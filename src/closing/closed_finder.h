// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "cabinet_articulation/articulation/learned_model.h"
#include "closing/closed_search.h"
#include "closing/view_memory.h"

namespace cabinet_articulation::core {

/// Tells learned joints where they are closed. The first observed position stays q = 0, so that nobody who holds a q is misled
/// when the closed position becomes known. The place is kept in space, not as a q: a joint that is learned better gets another
/// q_closed for the same place. A frame costs one search at most (some 5 ms). A joint costs one in 0.3 s, or once its place is
/// known, when it was seen a quarter more often.
///
/// The detector loses a front that shuts while it is some degrees open. The views show it shut: then its joint is at q_closed, at
/// the stamp of the newest view that shows so. Once views show its place empty, it is where it was detected last. Either takes
/// views for 0.3 s that agree. What is hidden or out of view stays where it was seen last.
class ClosedFinder {
 public:
  /// What the camera saw in the frame whose joints come next.
  void see(DepthView view) { memory_.add(std::move(view)); }

  /// Fills q_closed, closed_known and opening of every model. Also q, the range and the stamp of those that were seen shut.
  void complete(std::vector<LearnedModel>* models);

  /// The fronts that complete() set to closed the time before last, and did not last time. Unless they were detected, their q
  /// changed without an observation, and their stamp went back. Some may not be among the models any more.
  const std::set<std::uint32_t>& leftClosed() const { return left_closed_; }

  /// Joints of an earlier run, with what was known of them.
  void remember(const std::vector<LearnedModel>& joints);

  void forget(std::uint32_t id) { places_.erase(id); }

  void reset() { *this = ClosedFinder(); }

 private:
  struct Place {
    bool known = false;
    ClosedPlace closed;
    bool searched = false;
    double searched_at = 0;  ///< [s] stamp of the newest view then
    int observations = 0;    ///< of the joint then
    FrontHistory history;
    double watched_at = 0;           ///< [s] stamp of the newest view in which it was looked whether the front is shut
    std::optional<bool> shown_shut;  ///< what the last such view said that said anything; nothing once the front was detected
    double shown_since = 0;          ///< [s] stamp of the first of the views that said the same without a break
    double shut_at = 0;              ///< [s] stamp of the newest that shows it shut, once they are enough; 0: it is not
    bool was_shut = false;           ///< ever
  };

  void forgetOthers(const std::vector<LearnedModel>& models);
  void noteSightings(const std::vector<LearnedModel>& models);
  bool isDue(const LearnedModel& model, double now) const;
  void searchOne(const std::vector<LearnedModel>& models);
  void watch(const LearnedModel& model, Place* place) const;

  ViewMemory memory_;
  std::map<std::uint32_t, Place> places_;
  std::set<std::uint32_t> closed_, left_closed_;  ///< ids
};

}  // namespace cabinet_articulation::core
