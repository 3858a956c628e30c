// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "articulation/decision/candidate.h"
#include "articulation/fitting/work_schedule.h"
#include "articulation/observations/observation_history.h"
#include "cabinet_articulation/articulation/articulation_config.h"

namespace cabinet_articulation::core {

/// The evidence of models that move, by how likely the sequence of a track's poses is to each. What takes long is spread over
/// updates. A comparison stays with the poses it began with until it is done, and says what it has found so far.
class JointTypeComparison {
 public:
  /// Poses by which moving models are compared where that is clear: runs of a long track tell as much of its noise as all.
  static constexpr std::size_t kRunPoses = 120;

  explicit JointTypeComparison(const ArticulationConfig& config) : config_(config) {}

  /// The next begins anew; until it is done, what was found before stays.
  void reset() { compared_at_ = 0; }

  /// Sets the evidence of candidates that move.
  void update(const ObservationHistory& poses, ReferencePoint reference, const WorkSchedule& schedule,
              std::vector<Candidate>* candidates);

 private:
  struct Entry {
    const ArticulationModel* model = nullptr;
    bool compared = false;
    double log_likelihood = 0, evidence = 0;
    bool settled = true;
  };

  void compare(const std::vector<Candidate>& candidates, const WorkSchedule& schedule);
  void advance(const std::vector<Candidate>& candidates, const WorkSchedule& schedule);
  void set(std::size_t i, const SequenceProgress& progress);
  bool isOf(const std::vector<Candidate>& candidates) const;
  std::optional<double> rivalOf(std::size_t i) const;
  bool isSettled() const;
  bool isClear() const;

  ArticulationConfig config_;
  std::size_t compared_at_ = 0;  ///< poses of the track when the comparison began; 0: none did
  bool close_ = false;           ///< the few poses that are compared first did not tell
  PoseSequence track_;           ///< what is compared
  double compared_path_ = 0;     ///< [m] of the best model then
  std::vector<Entry> entries_;   ///< of the candidates
  std::vector<Entry> verdict_;   ///< the same when a comparison came to its end last
  std::size_t turn_ = 0;         ///< whose is the next step
};

}  // namespace cabinet_articulation::core
