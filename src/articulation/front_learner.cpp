// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/front_learner.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cabinet_articulation/articulation/model_registry.h"
#include "cabinet_articulation/articulation/motion_test.h"
#include "cabinet_articulation/articulation/range_ends.h"

namespace cabinet_articulation::core {
namespace {

/// Poses by which moving models are compared where that is clear: runs of a long track tell as much of its noise as all.
constexpr std::size_t kRunPoses = 160;

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

/// A hinge lies in the front's plane or close to it. Planes that touch a bottle or an arm here and there turn about an axis
/// that lies behind them; what hands leave to see of a plane turns within it.
bool isNoHinge(const Candidate& candidate, const Eigen::Isometry3d& T_reference_center) {
  const JointGeometry geometry = candidate.model->geometry();
  if (geometry.radius == 0) return false;
  const Eigen::Isometry3d center = candidate.model->predict(0) * T_reference_center;
  Eigen::Vector3d to_axis = geometry.axis_point - center.translation();
  to_axis -= geometry.axis * geometry.axis.dot(to_axis);
  const double across = std::abs(center.linear().col(2).dot(to_axis));
  const double upright = center.linear().col(2).dot(geometry.axis);
  return across * across > 0.5 * to_axis.squaredNorm() || upright * upright > 0.5;
}

}  // namespace

FrontLearner::FrontLearner(const ArticulationConfig& config) : config_(config), observations_(config) { createModels(); }

void FrontLearner::chooseReference(const Track& track) {
  // The choice changes what q means, so it is only looked at again when twice as much is known.
  constexpr std::size_t kFew = 8;
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

void FrontLearner::compareMotions(const MotionTest& test) {
  // What was clear stays clear until a good deal more is known.
  const bool known = compared_at_ > 0 && evidences_.size() == candidates_.size() && 10 * observations_.size() < 11 * compared_at_;
  if (!known || !isClear()) {
    const double limit = 3 * config_.sigma_position;
    compareSequences(fromExplained(poses_, candidates_, limit));
    const bool moves = std::any_of(candidates_.begin(), candidates_.end(), [&](const Candidate& candidate) {
      return candidate.model->moves() && test.passes(*candidate.model, candidate.residuals, spaced_);
    });
    if (moves && !isClear() && poses_.size() < observations_.size()) {
      const auto all = static_cast<std::size_t>(config_.sequence_poses_max);
      compareSequences(fromExplained(observations_.track(reference_, all), candidates_, limit));
    }
    compared_at_ = observations_.size();
  }
  for (std::size_t i = 0; i < candidates_.size(); ++i) candidates_[i].evidence = evidences_[i];
}

void FrontLearner::compareSequences(const PoseTrack& track) {
  evidences_.assign(candidates_.size(), 0);
  std::optional<double> rival;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    ArticulationModel& model = *candidates_[i].model;
    if (!model.moves()) continue;
    const double likelihood = model.sequenceLogLikelihood(track, rival);
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
  MotionTest test(track, poses_, config_);
  compareMotions(test);
  const Eigen::Isometry3d T_reference_center(Eigen::Translation3d(-reference_.offset(front_.width, front_.height)));
  const Candidate* moving = bestMoving(candidates_);
  // Only of rectangles is it known how they lie in space: a marker may be stuck on any way round.
  const bool is_rectangle = poses_.has_orientation && front_.width > 0;
  if (moving && is_rectangle && isNoHinge(*moving, T_reference_center)) test.refuse();
  if (!moving || moving->outlier_share > config_.outlier_share_max) fitModels(spaced_, false);
  selection_ = selectModel(&candidates_, spaced_, test, config_);
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
  const ArticulationModel& model = *candidate.model;
  const ModelResiduals& residuals = candidate.residuals;
  LearnedModel learned;
  learned.id = front_.id;
  learned.stamp = poses_.stamps.back();
  learned.type = model.type();
  learned.probabilities = selection_.probabilities;
  learned.moved = selection_.moved;
  learned.explained = selection_.explained;
  learned.width = front_.width;
  learned.height = front_.height;
  learned.origin = model.predict(0);
  learned.origin.translate(-reference_.offset(front_.width, front_.height));
  const JointGeometry geometry = model.geometry();
  learned.axis = geometry.axis;
  learned.curve = model.curve(residuals.q_min, residuals.q_max);
  for (Eigen::Isometry3d& pose : learned.curve) pose.translate(-reference_.offset(front_.width, front_.height));
  if (geometry.radius > 0) {
    const Eigen::Vector3d away = learned.origin.translation() - geometry.axis_point;
    learned.axis_point = geometry.axis_point + geometry.axis * geometry.axis.dot(away);
    learned.radius = (learned.origin.translation() - learned.axis_point).norm();
  }
  learned.q = model.configuration(poses_.poses.back());
  learned.q_min = residuals.q_min;
  learned.q_max = residuals.q_max;
  const RangeEnds ends = seenEnds(residuals.q, spaced_.stamps, residuals.q_min, residuals.q_max);
  learned.q_min_is_end = model.moves() && ends.min;
  learned.q_max_is_end = model.moves() && ends.max;
  learned.observations = static_cast<int>(observations_.size());
  const double n = static_cast<double>(residuals.q.size());
  for (std::size_t i = 0; i < residuals.q.size(); ++i) {
    learned.position_error += residuals.position[i].norm() / n;
    learned.orientation_error += residuals.orientation[i].norm() / n;
  }
  if (learned.moved || !model.moves())
    learned.covariance = model.covariance(spaced_, learned.origin.translation(), candidate.memory);
  learned.params = model.parameters();
  const double parameters = model.complexity(spaced_.has_orientation);
  const auto add = [&learned](const char* name, double value, ModelParam::Kind kind) {
    learned.params.push_back({name, value, kind});
  };
  add("sigma_position", config_.sigma_position, ModelParam::kPrior);
  add("sigma_orientation", config_.sigma_orientation, ModelParam::kPrior);
  add("complexity", parameters, ModelParam::kEval);
  add("dofs", model.moves() ? 1 : 0, ModelParam::kEval);
  add("samples", n, ModelParam::kEval);
  add("q_min[0]", residuals.q_min, ModelParam::kEval);
  add("q_max[0]", residuals.q_max, ModelParam::kEval);
  add("avg_error_position", learned.position_error, ModelParam::kEval);
  add("avg_error_orientation", learned.orientation_error, ModelParam::kEval);
  add("outlier_ratio", candidate.outlier_share, ModelParam::kEval);
  add("loglikelihood", candidate.log_likelihood, ModelParam::kEval);
  add("evidence", candidate.evidence, ModelParam::kEval);
  add("correlation", candidate.correlation, ModelParam::kEval);
  add("bic", -2 * candidate.log_likelihood + parameters * std::log(n), ModelParam::kEval);
  return learned;
}

}  // namespace cabinet_articulation::core
