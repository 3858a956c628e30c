// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/front_learner.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cabinet_articulation/articulation/model_registry.h"
#include "cabinet_articulation/articulation/motion_criterion.h"
#include "model_description.h"

namespace cabinet_articulation::core {
namespace {

/// Poses by which moving models are compared where that is clear: runs of a long track tell as much of its noise as all.
constexpr std::size_t kRunPoses = 120;

/// [nats] Between the evidence of moving models.
constexpr double kClear = 25;

/// Runs of poses from the first that at least one of the models explains: a sequence is tied to the path by its first
/// residual, which must not be a false detection.
PoseTrack fromExplained(const PoseTrack& track, const std::vector<Candidate>& candidates, double limit) {
  const auto explained = [&](const Eigen::Isometry3d& pose) {
    return std::any_of(candidates.begin(), candidates.end(), [&](const Candidate& candidate) {
      if (!candidate.model->moves()) return false;
      const Eigen::Isometry3d predicted = candidate.model->predict(candidate.model->configuration(pose));
      return (pose.translation() - predicted.translation()).norm() <= limit;
    });
  };
  std::vector<std::size_t> indices;
  std::vector<char> run_starts;
  bool waiting = true;
  for (std::size_t i = 0; i < track.size(); ++i) {
    waiting = waiting || track.startsRun(i);
    if (waiting && !explained(track.poses[i])) continue;
    indices.push_back(i);
    run_starts.push_back(waiting);
    waiting = false;
  }
  if (indices.empty()) return track;
  PoseTrack sequence = selected(track, indices);
  sequence.run_starts = run_starts;
  return sequence;
}

/// The candidate that explains motion best; null without one.
const Candidate* bestMoving(const std::vector<Candidate>& candidates) {
  const Candidate* best = nullptr;
  for (const Candidate& candidate : candidates)
    if (candidate.model->moves() && (!best || candidate.evidence > best->evidence)) best = &candidate;
  return best;
}

/// A hinge lies in the front's plane or close to it, and no farther from the front's centre than its edges. Planes that touch
/// a bottle or an arm here and there turn about an axis that lies behind them; what hands leave to see of a plane turns within
/// it. Small turns leave it uncertain where their axis is.
bool isNoHinge(const Candidate& candidate, const Track& front, const Eigen::Isometry3d& T_reference_center, double sigma_edge) {
  constexpr double kExtents = 0.75;     // half of the diagonal of a square, and some
  constexpr double kRoundThing = 0.25;  // [m] small enough for a bottle, whose faces turn about its middle
  const JointGeometry geometry = candidate.model->geometry();
  if (geometry.radius == 0) return false;
  const Eigen::Isometry3d center = candidate.model->predict(0) * T_reference_center;
  Eigen::Vector3d to_axis = geometry.axis_point - center.translation();
  to_axis -= geometry.axis * geometry.axis.dot(to_axis);
  const double across = std::abs(center.linear().col(2).dot(to_axis));
  const double off_plane = std::max(front.width, front.height) < kRoundThing ? 0.4 : std::sqrt(0.5);
  const double upright = center.linear().col(2).dot(geometry.axis);
  const double unsure = sigma_edge / std::max(candidate.residuals.q_max - candidate.residuals.q_min, 1e-6);
  return to_axis.norm() > kExtents * std::max(front.width, front.height) + unsure ||
         across > off_plane * to_axis.norm() + unsure || upright * upright > 0.5;
}

}  // namespace

FrontLearner::FrontLearner(const ArticulationConfig& config) : config_(config), observations_(config) { createModels(); }

void FrontLearner::chooseReference(const Track& track) {
  // The choice changes what q means, so it is only looked at again when twice as much is known; a few poses may err in it.
  constexpr std::size_t kFew = 16;
  if (observations_.size() >= kFew && observations_.size() < 2 * reference_chosen_at_) return;
  const ReferencePoint* chosen = reference_chosen_at_ > 0 ? &reference_ : nullptr;
  const ReferencePoint best = bestReferencePoint(observations_, track.width, track.height, chosen, config_);
  const bool changed = !chosen || best.x != chosen->x || best.y != chosen->y;
  reference_ = best;
  reference_chosen_at_ = std::max(kFew / 2, observations_.size());
  if (!changed) return;
  createModels();
  compared_at_ = 0;
}

void FrontLearner::createModels() {
  models_.clear();
  for (const ModelEntry& entry : modelRegistry())
    if (config_.*entry.enabled) models_.push_back(entry.create(config_));
}

void FrontLearner::fitModels(const PoseTrack& track, bool parametric) {
  for (const auto& model : models_)
    if (model->isParametric() == parametric && model->fit(track))
      candidates_.push_back(evaluateCandidate(model.get(), track, config_));
}

void FrontLearner::compareMotions(const MotionCriterion& criterion) {
  const bool moves = std::any_of(candidates_.begin(), candidates_.end(), [&](const Candidate& candidate) {
    return candidate.model->moves() && (criterion.passes(*candidate.model, candidate.residuals, spaced_) ||
                                        criterion.isEvidentEarly(*candidate.model, candidate.residuals, spaced_));
  });
  // How a front moves that stands still is not worth the time.
  if (!moves) compared_at_ = 0;
  // What was clear stays clear until a good deal more is known.
  const bool known = compared_at_ > 0 && evidences_.size() == candidates_.size() && 10 * observations_.size() < 11 * compared_at_;
  if (moves && !(known && isClear())) {
    const double limit = 3 * config_.sigma_position;
    compareSequences(fromExplained(poses_, candidates_, limit));
    const auto more = static_cast<std::size_t>(config_.sequence_poses_max);
    if (!isClear() && poses_.size() < std::min(more, observations_.size()))
      compareSequences(fromExplained(observations_.runs(reference_, more), candidates_, limit));
    compared_at_ = observations_.size();
  }
  for (std::size_t i = 0; i < candidates_.size(); ++i) candidates_[i].evidence = moves ? evidences_[i] : 0;
}

void FrontLearner::compareSequences(const PoseTrack& track) {
  evidences_.assign(candidates_.size(), 0);
  std::optional<double> rival;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    ArticulationModel& model = *candidates_[i].model;
    if (!model.moves()) continue;
    // So few poses do not tell how their residuals follow one another; what they say of their noise has to do.
    const bool few = track.size() < MotionCriterion::kFew && !track.orientation_weights.empty();
    const double likelihood = few ? 0 : model.sequenceLogLikelihood(track, rival);
    evidences_[i] = likelihood - 0.5 * model.complexity(track.has_orientation) * std::log(static_cast<double>(track.size()));
    rival = std::max(rival.value_or(likelihood), likelihood);
  }
}

bool FrontLearner::isClear() const {
  double first = -std::numeric_limits<double>::infinity(), second = first;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    if (!candidates_[i].model->moves()) continue;
    second = std::max(second, std::min(first, evidences_[i]));
    first = std::max(first, evidences_[i]);
  }
  return first - second > kClear;
}

bool FrontLearner::update(const Track& track) {
  if (!observations_.update(track)) return false;
  chooseReference(track);
  poses_ = observations_.runs(reference_, kRunPoses);
  poses_.outline = observations_.outline(reference_, track.width, track.height);
  front_.id = track.id;
  front_.width = track.width;
  front_.height = track.height;
  spaced_ = observations_.track(reference_, static_cast<std::size_t>(config_.poses_max));
  spaced_.outline = poses_.outline;
  candidates_.clear();
  fitModels(spaced_, true);
  if (candidates_.empty()) return false;
  const MotionCriterion criterion(track, poses_, config_);
  compareMotions(criterion);
  const Eigen::Isometry3d T_reference_center(Eigen::Translation3d(-reference_.offset(front_.width, front_.height)));
  const bool is_rectangle = poses_.has_orientation && front_.width > 0;
  for (Candidate& candidate : candidates_)
    candidate.plausible = !is_rectangle || !isNoHinge(candidate, front_, T_reference_center, config_.sigma_edge);
  const Candidate* moving = bestMoving(candidates_);
  if (!moving || !explains(*moving, config_)) fitModels(spaced_, false);
  selection_ = selectModel(&candidates_, spaced_, criterion, config_);
  learned_ = describe(candidates_[selection_.best]);
  return true;
}

std::vector<LearnedModel> FrontLearner::candidates() const {
  std::vector<LearnedModel> all;
  for (const Candidate& candidate : candidates_) all.push_back(describe(candidate));
  const auto probability = [](const LearnedModel& model) { return model.probabilities[static_cast<std::size_t>(model.type)]; };
  std::stable_sort(all.begin(), all.end(),
                   [&](const LearnedModel& a, const LearnedModel& b) { return probability(a) > probability(b); });
  return all;
}

LearnedModel FrontLearner::describe(const Candidate& candidate) const {
  LearnedModel learned;
  learned.id = front_.id;
  learned.stamp = poses_.stamps.back();
  learned.type = candidate.model->type();
  learned.probabilities = selection_.probabilities;
  learned.moved = selection_.moved;
  learned.explained = selection_.explained;
  learned.width = front_.width;
  learned.height = front_.height;
  learned.observations = static_cast<int>(observations_.size());
  describeGeometry(candidate, reference_.offset(front_.width, front_.height), &learned);
  learned.q = candidate.model->configuration(poses_.poses.back());
  describeRange(candidate, spaced_.stamps, &learned);
  if (learned.moved || !candidate.model->moves())
    learned.covariance = candidate.model->covariance(spaced_, learned.origin.translation(), candidate.memory);
  describeFit(candidate, spaced_, config_, &learned);
  return learned;
}

}  // namespace cabinet_articulation::core
