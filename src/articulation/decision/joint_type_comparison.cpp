// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/decision/joint_type_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "articulation/decision/motion_detection.h"
#include "articulation/fitting/arc_fit.h"

namespace cabinet_articulation::core {
namespace {

/// [nats] Between the evidence of moving models.
constexpr double kClear = 25;

/// Runs of poses from the first that at least one of the models explains, and that the next pose agrees with. A sequence is tied
/// to the path by its first residual, which must not be a false detection.
PoseSequence fromExplained(const PoseSequence& track, const std::vector<Candidate>& candidates, double limit, double hand_speed) {
  const auto explained = [&](const Eigen::Isometry3d& pose) {
    return std::any_of(candidates.begin(), candidates.end(), [&](const Candidate& candidate) {
      if (!candidate.model->moves()) return false;
      const Eigen::Isometry3d predicted = candidate.model->predict(candidate.model->configuration(pose));
      return (pose.translation() - predicted.translation()).norm() <= limit;
    });
  };
  const auto continues = [&](std::size_t i) {
    if (i + 1 >= track.size() || track.startsRun(i + 1)) return true;
    const double step = (track.poses[i + 1].translation() - track.poses[i].translation()).norm();
    return step <= limit + hand_speed * (track.stamps[i + 1] - track.stamps[i]);
  };
  std::vector<std::size_t> indices;
  std::vector<char> run_starts;
  bool waiting = true;
  for (std::size_t i = 0; i < track.size(); ++i) {
    waiting = waiting || track.startsRun(i);
    if (waiting && !(explained(track.poses[i]) && continues(i))) continue;
    indices.push_back(i);
    run_starts.push_back(waiting);
    waiting = false;
  }
  if (indices.empty()) return track;
  PoseSequence sequence = selected(track, indices);
  sequence.run_starts = run_starts;
  return sequence;
}

/// [m] By the model that explains the poses best.
double pathOfBest(const std::vector<Candidate>& candidates) {
  const Candidate* best = nullptr;
  for (const Candidate& candidate : candidates)
    if (candidate.model->moves() && (!best || candidate.log_likelihood > best->log_likelihood)) best = &candidate;
  return best ? best->residuals.path : 0;
}

}  // namespace

void JointTypeComparison::update(const ObservationHistory& poses, ReferencePoint reference, const WorkSchedule& schedule,
                                 std::vector<Candidate>* candidates) {
  const bool goes_on = compared_at_ > 0 && !schedule.isEverything() && isOf(*candidates);
  const auto more = static_cast<std::size_t>(config_.sequence_poses_max);
  const double path = pathOfBest(*candidates);
  // Without an earlier verdict a first glance would be taken for one.
  const bool thorough = schedule.isEverything() || verdict_.empty();
  const auto begin = [&](std::size_t count) {
    const PoseSequence runs = poses.runs(reference, count);
    track_ = fromExplained(runs, *candidates, outlierDistance(runs, config_), config_.prior.hand_speed);
    compared_at_ = poses.size();
    compared_path_ = path;
    entries_.assign(candidates->size(), {});
    for (std::size_t i = 0; i < candidates->size(); ++i) entries_[i].model = (*candidates)[i].model;
    thorough ? compare(*candidates, schedule) : advance(*candidates, schedule);
  };
  if (!goes_on) close_ = false;
  // What was clear stays clear until a good deal more was seen, or a bit more of the way.
  const bool known = isClear() && 10 * poses.size() < 11 * compared_at_ && path < 1.1 * compared_path_;
  if (goes_on && !isSettled())
    advance(*candidates, schedule);
  else if (!goes_on || !known)
    begin(close_ ? more : kRunPoses);
  if (isSettled() && !isClear() && !close_ && std::min(more, poses.size()) > kRunPoses) {
    close_ = true;
    if (thorough) begin(more);
  }
  // Until the next comparison has come to an end, the last one tells more.
  if (thorough || isSettled()) verdict_ = entries_;
  for (Candidate& candidate : *candidates) {
    const auto isSame = [&](const Entry& entry) { return entry.model == candidate.model; };
    const auto known = std::find_if(verdict_.begin(), verdict_.end(), isSame);
    candidate.evidence = known == verdict_.end() ? -std::numeric_limits<double>::infinity() : known->evidence;
  }
}

bool JointTypeComparison::isOf(const std::vector<Candidate>& candidates) const {
  const auto isSame = [](const Entry& entry, const Candidate& candidate) { return entry.model == candidate.model; };
  return std::equal(entries_.begin(), entries_.end(), candidates.begin(), candidates.end(), isSame);
}

void JointTypeComparison::compare(const std::vector<Candidate>& candidates, const WorkSchedule& schedule) {
  // The first look goes on until it settles; other optima have to wait.
  const WorkBudget budget = schedule.isEverything() ? WorkBudget::unlimited() : WorkBudget::ofSteps(kMostSteps);
  // So few poses do not tell how their residuals follow one another; what they say of their noise has to do.
  const bool few = track_.size() < MotionDetector::kFewPoses && !track_.orientation_weights.empty();
  std::vector<std::optional<double>> rivals(candidates.size());
  const auto look = [&](std::size_t i) {
    ArticulationModel& model = *candidates[i].model;
    rivals[i] = rivalOf(i);
    set(i, few ? SequenceProgress() : model.sequenceLogLikelihood(track_, budget, rivals[i]));
  };
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (candidates[i].model->moves()) look(i);
  // A fit ends early beside a rival that is clearly worse; one that was found since may be closer. The first had no rival.
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (rivals[i] && *rivalOf(i) > *rivals[i] + kFineFit) look(i);
}

/// As many steps as there is time for, of one model after the other where that is not even one for each.
void JointTypeComparison::advance(const std::vector<Candidate>& candidates, const WorkSchedule& schedule) {
  const bool is_first = std::none_of(entries_.begin(), entries_.end(), [](const Entry& entry) { return entry.compared; });
  std::size_t joints = 0;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    ArticulationModel& model = *candidates[i].model;
    if (!model.moves()) continue;
    joints += model.isParametric();
    if (!entries_[i].compared) set(i, model.sequenceLogLikelihood(track_, WorkBudget::ofSteps(0), std::nullopt));
    if (!entries_[i].settled) open.push_back(i);
  }
  const int count = static_cast<int>(open.size());
  const int steps = schedule.comparison(joints, track_.size()).steps() - is_first;  // a first look is a step
  for (int k = 0; k < std::min(steps, count); ++k) {
    const std::size_t i = open[turn_++ % open.size()];
    ArticulationModel& model = *candidates[i].model;
    set(i, model.sequenceLogLikelihood(track_, WorkBudget::ofSteps(std::max(1, steps / count)), rivalOf(i)));
  }
}

void JointTypeComparison::set(std::size_t i, const SequenceProgress& progress) {
  const ArticulationModel& model = *entries_[i].model;
  const double penalty = 0.5 * model.complexity(track_.has_orientation) * std::log(static_cast<double>(track_.size()));
  entries_[i] = {&model, true, progress.log_likelihood, progress.log_likelihood - penalty + model.logPrior(), progress.settled};
}

std::optional<double> JointTypeComparison::rivalOf(std::size_t i) const {
  std::optional<double> best;
  for (std::size_t k = 0; k < entries_.size(); ++k)
    if (k != i && entries_[k].compared) best = std::max(best.value_or(entries_[k].log_likelihood), entries_[k].log_likelihood);
  return best;
}

bool JointTypeComparison::isSettled() const {
  return std::all_of(entries_.begin(), entries_.end(), [](const Entry& entry) { return entry.settled; });
}

bool JointTypeComparison::isClear() const {
  double first = -std::numeric_limits<double>::infinity(), second = first;
  for (const Entry& entry : entries_) {
    if (!entry.compared) continue;
    second = std::max(second, std::min(first, entry.evidence));
    first = std::max(first, entry.evidence);
  }
  return first - second > kClear;
}

}  // namespace cabinet_articulation::core
