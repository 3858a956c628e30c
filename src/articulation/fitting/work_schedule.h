// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

namespace cabinet_articulation::core {

/// The steps that a fit may take now. A step looks at each pose once.
class WorkBudget {
 public:
  /// A fresh fit, to its end.
  static WorkBudget unlimited() { return WorkBudget(std::numeric_limits<int>::max()); }
  /// So many steps on from the last fit.
  static WorkBudget ofSteps(int steps) { return WorkBudget(steps); }

  bool isUnlimited() const { return steps_ == std::numeric_limits<int>::max(); }
  int steps() const { return steps_; }

 private:
  explicit WorkBudget(int steps) : steps_(steps) {}

  int steps_;
};

/// What each part of the learner may do in one update of a front (ours). An update after one more observation takes some 0.3 ms
/// (learner_benchmark); what needs more is spread over the updates that follow.
class WorkSchedule {
 public:
  static constexpr std::size_t kShortTrack = 16;  ///< observations; fewer are learned anew each time, with all work at once

  /// All at once.
  static WorkSchedule everything() { return {}; }

  /// For `observations`, of which `known` were there at the last update. Much that is new is learned at once.
  static WorkSchedule ofUpdate(std::size_t known, std::size_t observations) {
    WorkSchedule schedule;
    schedule.everything_ = observations < kShortTrack || 4 * observations >= 5 * known;
    schedule.turn_ = observations;
    return schedule;
  }

  bool isEverything() const { return everything_; }

  /// For the fit of one joint: steps of an arc, or one round of a curve.
  WorkBudget fit(std::size_t poses) const { return budget(kFitWork, poses); }

  /// For the comparison of so many joint types, all together.
  WorkBudget comparison(std::size_t joints, std::size_t poses) const {
    return budget(kComparisonWork * static_cast<int>(joints) / 2, poses);
  }

  /// Whether the next of the joints that are not the best so far keeps its last fit: every second, in turn.
  bool nextRests(std::size_t poses) { return !everything_ && poses > kTurnPoses && ++turn_ % 2 == 1; }

 private:
  // Poses times steps, each some 0.5 us (measured): 0.08 ms a joint, and 0.18 ms to compare two.
  static constexpr int kFitWork = 160;
  static constexpr int kComparisonWork = 360;

  static constexpr std::size_t kTurnPoses = 60;  ///< so few can be fitted by all joints

  WorkBudget budget(int work, std::size_t poses) const {
    return everything_ ? WorkBudget::unlimited() : WorkBudget::ofSteps(std::max(1, work / static_cast<int>(poses)));
  }

  bool everything_ = true;
  std::size_t turn_ = 0;
};

}  // namespace cabinet_articulation::core
