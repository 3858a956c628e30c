// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/front_learner.h"

#include <algorithm>
#include <cmath>

#include "cabinet_articulation/articulation/model_registry.h"
#include "cabinet_articulation/articulation/motion_test.h"

namespace cabinet_articulation::core {
namespace {

/// The track from the first pose that at least one of the models explains: a sequence is tied to the path by its first
/// residual, which must not be a false detection.
PoseTrack fromFirstExplained(const PoseTrack& track, const std::vector<Candidate>& candidates, double limit) {
  for (std::size_t first = 0; first < track.size(); ++first) {
    const Eigen::Isometry3d& pose = track.poses[first];
    for (const Candidate& candidate : candidates) {
      if (!candidate.model->moves()) continue;
      const Eigen::Isometry3d predicted = candidate.model->predict(candidate.model->configuration(pose));
      if ((pose.translation() - predicted.translation()).norm() <= limit) return tail(track, first);
    }
  }
  return track;
}

/// The candidate that explains motion best; null without one.
const Candidate* bestMoving(const std::vector<Candidate>& candidates) {
  const Candidate* best = nullptr;
  for (const Candidate& candidate : candidates)
    if (candidate.model->moves() && (!best || candidate.evidence > best->evidence)) best = &candidate;
  return best;
}

/// A hinge lies in the front's plane or close to it. Planes that touch a bottle or an arm here and there turn about an axis
/// that lies behind them.
bool isTouchingSomethingRound(const Candidate& candidate, const Eigen::Isometry3d& T_reference_center) {
  const JointGeometry geometry = candidate.model->geometry();
  if (geometry.radius == 0) return false;
  const Eigen::Isometry3d center = candidate.model->predict(0) * T_reference_center;
  Eigen::Vector3d to_axis = geometry.axis_point - center.translation();
  to_axis -= geometry.axis * geometry.axis.dot(to_axis);
  const double across = std::abs(center.linear().col(2).dot(to_axis));
  return across * across > 0.5 * to_axis.squaredNorm();
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
  if (changed) createModels();
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

void FrontLearner::compareSequences(const PoseTrack& track) {
  std::optional<double> rival;
  for (Candidate& candidate : candidates_) {
    if (!candidate.model->moves()) continue;
    const double parameters = candidate.model->complexity(track.has_orientation);
    const double likelihood = candidate.model->sequenceLogLikelihood(track, rival);
    candidate.evidence = likelihood - 0.5 * parameters * std::log(static_cast<double>(track.size()));
    rival = std::max(rival.value_or(likelihood), likelihood);
  }
}

bool FrontLearner::update(const Track& track) {
  if (!observations_.update(track)) return false;
  chooseReference(track);
  poses_ = observations_.track(reference_, static_cast<std::size_t>(config_.sequence_poses_max));
  poses_.outline = observations_.outline(reference_, track.width, track.height);
  front_.id = track.id;
  front_.width = track.width;
  front_.height = track.height;
  const PoseTrack spaced = thinned(poses_, static_cast<std::size_t>(config_.poses_max));
  candidates_.clear();
  fitModels(spaced, true);
  compareSequences(fromFirstExplained(poses_, candidates_, 3 * config_.sigma_position));
  if (candidates_.empty()) return false;
  MotionTest test(track, poses_, config_);
  const Eigen::Isometry3d T_reference_center(Eigen::Translation3d(-reference_.offset(front_.width, front_.height)));
  const Candidate* moving = bestMoving(candidates_);
  // Only of rectangles is it known how they lie in space: a marker may be stuck on any way round.
  const bool is_rectangle = poses_.has_orientation && front_.width > 0;
  if (moving && is_rectangle && isTouchingSomethingRound(*moving, T_reference_center)) test.refuse();
  if (!moving || moving->outlier_share > config_.outlier_share_max) fitModels(spaced, false);
  selection_ = selectModel(&candidates_, spaced, test, config_);
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
  learned.observations = static_cast<int>(observations_.size());
  const double n = static_cast<double>(residuals.q.size());
  for (std::size_t i = 0; i < residuals.q.size(); ++i) {
    learned.position_error += residuals.position[i].norm() / n;
    learned.orientation_error += residuals.orientation[i].norm() / n;
  }
  const PoseTrack spaced = thinned(poses_, static_cast<std::size_t>(config_.poses_max));
  if (learned.moved || !model.moves())
    learned.covariance = model.covariance(spaced, learned.origin.translation(), candidate.correlation);
  learned.params = model.parameters();
  const double parameters = model.complexity(spaced.has_orientation);
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
