// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/learner/front_learner.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "articulation/decision/front_prior.h"
#include "articulation/decision/hinge_plausibility.h"
#include "articulation/decision/motion_detection.h"
#include "articulation/models/model_registry.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kEver = -std::numeric_limits<double>::infinity();  ///< [s] before every observation

double justBefore(double stamp) { return std::nextafter(stamp, kEver); }

/// Whether a simpler joint is more probable whatever a comparison finds.
bool isNegligible(const ArticulationModel& model, const std::vector<Candidate>& simpler) {
  constexpr double kLeastLogOdds = -2.3;  // [nats] ln 0.1: a joint ten times less probable is not compared (ours)
  return model.largestAdvantage() < kLeastLogOdds && std::any_of(simpler.begin(), simpler.end(), [](const Candidate& candidate) {
           return candidate.model->moves() && candidate.model->isParametric();
         });
}

/// The candidate that explains motion best; null without one.
const Candidate* bestMoving(const std::vector<Candidate>& candidates) {
  const Candidate* best = nullptr;
  for (const Candidate& candidate : candidates)
    if (candidate.model->moves() && (!best || candidate.evidence > best->evidence)) best = &candidate;
  return best;
}

}  // namespace

FrontLearner::FrontLearner(const ArticulationConfig& config)
    : config_(config), observations_(config), comparison_(config), evidence_(config) {
  startAnew();
}

void FrontLearner::remember(const LearnedModel& joint) {
  evidence_.remember(joint);
  distrusts_past_ = !evidence_.isEstablished();
  if (!distrusts_past_) joint_ = joint;
  learned_ = joint;
}

void FrontLearner::startAnew() {
  models_.clear();
  for (const ModelEntry* entry : chosenModels(config_)) models_.push_back(entry->create(config_));
  reference_search_.reset();
  reference_chosen_at_ = 0;
  comparison_ = JointTypeComparison(config_);
  reference_ = {};
}

void FrontLearner::chooseReference(const Track& track) {
  // The choice changes what q means, so it is only looked at again when twice as much is known. A few poses may err in it.
  const bool due = observations_.size() < WorkSchedule::kShortTrack || observations_.size() >= 2 * reference_chosen_at_;
  if (!reference_search_ && !due) return;
  if (!reference_search_) reference_search_.emplace(config_);
  if (!reference_search_->advance(observations_, track.width, track.height, schedule_.isEverything())) return;
  const ReferencePoint best = reference_search_->best(reference_chosen_at_ > 0 ? &reference_ : nullptr);
  reference_search_.reset();
  reference_chosen_at_ = std::max(WorkSchedule::kShortTrack / 2, observations_.size());
  if (best.x == reference_.x && best.y == reference_.y) return;
  for (const auto& model : models_)
    model->moveReference(best.offset(track.width, track.height) - reference_.offset(track.width, track.height));
  reference_ = best;
  reference_moved_ = true;
  comparison_.reset();
}

void FrontLearner::fitModels(const PoseSequence& track, bool parametric) {
  for (auto entry = models_.begin(); entry != models_.end(); ++entry) {
    ArticulationModel& model = **entry;
    if (model.isParametric() != parametric) continue;
    const bool may_rest = parametric && !reference_moved_ && model.type() != learned_.type;
    // What can hardly win rests for four updates of five.
    const bool hopeless = model.largestAdvantage() < 0 && observations_.size() % 5 != 0 && !schedule_.isEverything();
    const bool rests = may_rest && (schedule_.nextRests(track.size()) || (hopeless && track.size() > WorkSchedule::kShortTrack));
    if (!rests && !model.fit(track, schedule_.fit(track.size()))) continue;
    if (isNegligible(model, candidates_)) continue;
    candidates_.push_back(evaluateCandidate(&model, track, config_));
    if (!schedule_.isEverything()) continue;
    for (auto next = std::next(entry); next != models_.end(); ++next) (*next)->startFrom(model);
  }
}

void FrontLearner::compareMotions(const MotionDetector* detector) {
  const bool moves = !detector || std::any_of(candidates_.begin(), candidates_.end(), [&](const Candidate& candidate) {
    return candidate.model->moves() && (detector->passes(*candidate.model, candidate.residuals, spaced_) ||
                                        detector->isEvidentEarly(*candidate.model, candidate.residuals, spaced_));
  });
  // How a front moves that stands still is not worth the time.
  if (!moves) return comparison_.reset();
  const bool newly_doubted = noteDoubt();
  comparison_.update(observations_, reference_, newly_doubted ? WorkSchedule::everything() : schedule_, &candidates_);
}

bool FrontLearner::update(const Track& track) {
  const std::size_t known = observations_.isContinuedBy(track) ? observations_.size() : 0;
  if (distrusts_past_ && !track.observations.empty()) observations_.leaveOutBefore(track.observations.back().stamp);
  distrusts_past_ = false;
  if (!observations_.update(track)) return false;
  placed_anew_ = known == 0;
  if (placed_anew_) startAnew();
  schedule_ = WorkSchedule::ofUpdate(known, observations_.size());
  front_.id = track.id;
  front_.width = track.width;
  front_.height = track.height;
  front_.hollow = track.hollow;
  learn(track);
  if (candidates_.empty()) return false;
  if (!weighEvidence() && !findOtherJoint(track)) {
    observations_.leaveOutBefore(evidence_.contradictedSince());
    learnAnew(track);
    if (candidates_.empty()) return false;
  }
  const bool is_joint = foundJoint();
  learned_ = !is_joint && evidence_.isEstablished() ? describeKnownJoint() : describe(candidates_[selection_.best]);
  if (is_joint) joint_ = learned_;
  learned_.support = evidence_.support();
  learned_.doubt = evidence_.doubt();
  // What was given up must be established again before it is told.
  learned_.moved = learned_.moved && learned_.doubt < 1;
  if (learned_.moved && observations_.leavesOut()) weighWhatIsLeftOut();
  return true;
}

/// Beside a joint that is established: the same one, or one of another type that is as sure.
bool FrontLearner::foundJoint() const {
  constexpr double kSureOfType = 0.999;  // the odds that establish a joint
  const ArticulationModel& best = *candidates_[selection_.best].model;
  if (!selection_.moved || !selection_.explained || !best.moves()) return false;
  if (!evidence_.isEstablished() || !joint_) return true;
  if (joint_->type != best.type()) return selection_.probabilities[static_cast<std::size_t>(best.type())] > kSureOfType;
  // A history that was placed anew takes the joint along.
  return placed_anew_ || evidence_.isRefinement(knownJoint(), joint_->q_min, joint_->q_max, best);
}

KnownJoint FrontLearner::knownJoint() const { return {*joint_, reference_.offset(front_.width, front_.height), config_}; }

void FrontLearner::learnAnew(const Track& track) {
  startAnew();
  schedule_ = WorkSchedule::everything();
  learn(track);
}

/// True once for each time that poses contradict the joint and are no single false detections. The comparison that the joint came
/// from may be out of date.
bool FrontLearner::noteDoubt() {
  constexpr double kSerious = 0.3;  // two of the five places that it takes at least (ours)
  if (evidence_.doubt() == 0) doubted_ = false;
  if (doubted_ || evidence_.doubt() < kSerious || evidence_.doubt() >= 1) return false;
  return doubted_ = true;
}

/// Instead of the joint that was given up: one that the whole history speaks for, and that is not contradicted.
bool FrontLearner::findOtherJoint(const Track& track) {
  learnAnew(track);
  if (candidates_.empty() || !foundJoint()) return false;
  const ArticulationModel& other = *candidates_[selection_.best].model;
  const PoseSequence contrary = posesSince(justBefore(evidence_.contradictedSince()));
  if (!JointEvidence::isOnPath(other, contrary)) return false;
  consider(other);
  return evidence_.isEstablished();
}

/// In place of a joint that was known.
void FrontLearner::consider(const ArticulationModel& joint) {
  joint_.reset();
  evidence_.consider(joint, posesSince(kEver), selection_.log_odds);
}

PoseSequence FrontLearner::posesSince(double stamp) const {
  PoseSequence poses = observations_.since(reference_, stamp);
  poses.outline = poses_.outline;
  return poses;
}

void FrontLearner::learn(const Track& track) {
  reference_moved_ = false;
  chooseReference(track);
  poses_ = observations_.runs(reference_, JointTypeComparison::kRunPoses);
  poses_.outline = observations_.outline(reference_, track.width, track.height);
  spaced_ = observations_.evenlySpaced(reference_, static_cast<std::size_t>(config_.poses_max));
  spaced_.outline = poses_.outline;
  candidates_.clear();
  fitModels(spaced_, true);
  if (candidates_.empty()) return;
  std::optional<MotionDetector> detector;
  if (!evidence_.isEstablished()) detector.emplace(track, poses_, config_);
  const MotionDetector* asked = detector ? &*detector : nullptr;
  // A log is of something that was moved. What a detector sees most likely rests, as does what has been watched at rest.
  const bool rested = !placed_anew_ && observations_.size() >= WorkSchedule::kShortTrack && !learned_.moved;
  const bool of_detector = !spaced_.orientation_weights.empty();
  const double at_rest = rested || of_detector ? std::log(config_.prior.rest_odds) : 0;
  const double least_odds = std::max(MotionDetector::kLogOdds, at_rest);
  compareMotions(asked);
  const Candidate* moving = bestMoving(candidates_);
  if (!moving || !explains(*moving, config_)) fitModels(spaced_, false);
  const Eigen::Isometry3d T_reference_center(Eigen::Translation3d(-reference_.offset(front_.width, front_.height)));
  const bool is_rectangle = poses_.has_orientation && front_.width > 0;
  for (Candidate& candidate : candidates_) {
    candidate.front_log_odds = is_rectangle ? frontLogOdds(candidate, front_, config_) : 0;
    candidate.plausible = !is_rectangle || !isImplausibleHinge(candidate, front_, T_reference_center, config_.sigma_edge);
  }
  selection_ = selectModel(&candidates_, spaced_, asked, least_odds, config_);
}

/// What the newest observations say of the joint that is known, or was just found. False if it is given up.
bool FrontLearner::weighEvidence() {
  const ArticulationModel& best = *candidates_[selection_.best].model;
  const bool is_joint = foundJoint();
  const bool established = evidence_.isEstablished();
  if (!established && !is_joint) return true;
  if (is_joint && (!established || joint_->type != best.type())) {
    consider(best);
    return true;
  }
  // Time may have been set back since; then only the newest pose is new.
  const PoseSequence fresh = posesSince(std::min(evidence_.weighedUntil(), justBefore(poses_.stamps.back())));
  return evidence_.weigh(knownJoint(), is_joint ? &best : nullptr, fresh);
}

}  // namespace cabinet_articulation::core
