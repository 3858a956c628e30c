// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/models/arc_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "articulation/fitting/initial_arc.h"
#include "articulation/paths/nearest_on_arc.h"

namespace cabinet_articulation::core {
namespace {

/// Enough poses to start from.
PoseSequence thinned(const PoseSequence& track) {
  constexpr std::size_t kPoses = 100;
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < track.size(); i += 1 + track.size() / kPoses) indices.push_back(i);
  return selected(track, indices);
}

/// Is it time to look from everywhere again?
bool isMuchMore(std::size_t poses, std::size_t before) { return poses > before + before / 4; }

}  // namespace

bool ArcModel::isEnough(const PoseSequence& track) const {
  return track.size() >= (shape_ == PathShape::kLine || track.has_orientation ? 2u : 3u);
}

bool ArcModel::fit(const PoseSequence& track, const WorkBudget& budget) {
  if (!isEnough(track)) return false;
  const bool continues = fitted_ && with_orientation_ == track.has_orientation && !budget.isUnlimited();
  with_orientation_ = track.has_orientation;
  fitted_ = true;
  const PoseSamples samples(track);
  continues ? continueFit(track, samples, budget.steps()) : fitAnew(samples);
  take(samples, fit_);
  return true;
}

void ArcModel::fitAnew(const PoseSamples& samples) {
  fit_ = fitArc(samples, shape_, {startOf(samples)}, FitEffort::fresh(), config_);
  updates_ = 0;
  fresh_.reset();
  sequence_.reset();
  others_.clear();
}

void ArcModel::continueFit(const PoseSequence& track, const PoseSamples& samples, int steps) {
  // A front that leaves the path it was thought to follow starts to move: its fit may be nowhere near.
  const bool leaves = std::sqrt(fit_.arc.squaredDistance(samples.positions.back())) > 3 * fit_.position_scale;
  if (fresh_) return continueBesidesFresh(samples, leaves ? 0 : (steps + ++updates_ % 2) / 2, steps);
  fit_ = fitArc(samples, shape_, fit_, FitEffort::continued(steps), config_);
  if (leaves || 10 * ++updates_ > static_cast<int>(samples.size())) {
    fresh_ = ArcFit{startOf(PoseSamples(thinned(track))), sigmaPosition(track, config_), config_.sigma_orientation_floor};
    updates_ = fresh_steps_ = 0;
  }
}

/// The two fits share the steps: `steps` of `all`.
void ArcModel::continueBesidesFresh(const PoseSamples& samples, int steps, int all) {
  constexpr int kFreshSteps = 8;
  fit_ = fitArc(samples, shape_, fit_, FitEffort::continued(steps), config_);
  fresh_ = fitArc(samples, shape_, *fresh_, FitEffort::continued(all - steps), config_);
  if (fresh_->cost < fit_.cost) std::swap(*fresh_, fit_);
  fresh_steps_ += all - steps;
  if (fresh_steps_ < kFreshSteps) return;
  fresh_.reset();
  updates_ = 0;
}

void ArcModel::take(const PoseSamples& samples, const ArcFit& fit) {
  fit_ = fit;
  arc_ = fit.arc;
  orient(samples);
  fit_.arc = arc_;
}

void ArcModel::moveReference(const Eigen::Vector3d& offset) {
  fit_.arc = fit_.arc.shifted(offset);
  fresh_.reset();
  if (sequence_) sequence_->arc = sequence_->arc.shifted(offset);
  for (SequenceFit& other : others_) other.arc = other.arc.shifted(offset);
}

Arc ArcModel::startOf(const PoseSamples& samples) const {
  return shape_ == PathShape::kLine ? consensusArc(samples, shape_, config_) : bestCircleStart(samples, config_);
}

void ArcModel::orient(const PoseSamples& samples) {
  if (arc_.curvature < 0) {
    arc_.curvature = -arc_.curvature;
    arc_.frame.rightCols<2>() *= -1;
  }
  arc_ = arc_.recentered(meanArcLength(arc_, samples.positions));
  const auto lengthOf = [this, &samples](std::size_t i) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = samples.positions[i];
    pose.linear() = samples.orientations[i].toRotationMatrix();
    return arcLength(pose);
  };
  double min = std::numeric_limits<double>::infinity(), max = -min;
  double first = std::numeric_limits<double>::quiet_NaN();
  const double limit = outlierDistance(samples, config_);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (arc_.squaredDistance(samples.positions[i]) > limit * limit) continue;
    const double s = lengthOf(i);
    if (std::isnan(first)) first = s;
    min = std::min(min, s);
    max = std::max(max, s);
  }
  if (std::isnan(first)) first = min = max = lengthOf(0);
  const double middle = (min + max) / 2;
  arc_ = arc_.recentered(middle);
  first_ = first - middle;
  if (max - first >= first - min) return;
  arc_.frame.col(0) *= -1;
  arc_.frame.col(2) *= -1;
  first_ = -first_;
}

double ArcModel::arcLength(const Eigen::Isometry3d& pose) const {
  double s = arc_.arcLength(pose.translation());
  if (shape_ == PathShape::kLine || !with_orientation_) return s;
  const double ratio = arc_.curvature * fit_.position_scale / fit_.orientation_scale;
  const auto turnAt = [this, &pose](double at) {
    const Eigen::Quaterniond rest(pose.linear() * arc_.pose(at).linear().transpose());
    const double twist = Eigen::Vector3d(rest.vec()).dot(arc_.axis());
    return 2 * std::atan2(rest.w() < 0 ? -twist : twist, std::abs(rest.w()));
  };
  if (kReachOfOrientations * ratio > 1) s = turnAt(0) / arc_.curvature;
  const Eigen::Isometry3d predicted = arc_.pose(s);
  const Eigen::Vector3d tangent = Eigen::AngleAxisd(arc_.curvature * s, arc_.axis()) * arc_.tangent();
  const double along = tangent.dot(pose.translation() - predicted.translation());
  return s + (along + ratio * ratio * turnAt(s) / arc_.curvature) / (1 + ratio * ratio);
}

double ArcModel::configuration(const Eigen::Isometry3d& pose) const { return (arcLength(pose) - first_) * unit(); }

SequenceProgress ArcModel::sequenceLogLikelihood(const PoseSequence& track, const WorkBudget& budget,
                                                 std::optional<double> rival) {
  const PoseSamples samples(track);
  return budget.isUnlimited() ? compareAnew(samples, rival) : continueComparison(samples, budget.steps(), rival);
}

SequenceFit ArcModel::sequenceFit(const PoseSamples& samples, const SequenceFit& start, const FitEffort& effort) const {
  return fitArcSequence(samples, shape_, fit_, start, effort, config_);
}

SequenceProgress ArcModel::compareAnew(const PoseSamples& samples, std::optional<double> rival) {
  const FitEffort effort = FitEffort::fresh(kFineFit, rival);
  const auto fitFrom = [&](const Arc& start) {
    return sequenceFit(samples, sequenceStart(samples, fit_, start, config_), effort);
  };
  sequence_ = fitFrom(arc_);
  others_.clear();
  // Circles have local optima: where it matters, they are looked for from everywhere.
  const bool close = rival && std::abs(sequence_->log_likelihood - *rival) < kClearDifference;
  if (shape_ == PathShape::kLine || !close) return {sequence_->log_likelihood, true};
  searched_at_ = samples.size();
  for (const Arc& start : typicalCircles(samples, arc_, config_.prior.door_radius)) {
    const SequenceFit fit = fitFrom(start);
    if (fit.log_likelihood > sequence_->log_likelihood) sequence_ = fit;
  }
  return {sequence_->log_likelihood, true};
}

SequenceProgress ArcModel::continueComparison(const PoseSamples& samples, int steps, std::optional<double> rival) {
  if (!sequence_) sequence_ = sequenceStart(samples, fit_, arc_, config_);
  // The last fit may have been to other poses: it is looked at anew, if only without a step.
  const bool tries_other = sequence_->settled && !others_.empty() && steps > 0;
  sequence_ = sequenceFit(samples, *sequence_, FitEffort::continued(tries_other ? 0 : steps));
  if (steps == 0) startFromFitIfBetter(samples);
  if (tries_other) tryOtherStart(samples, steps);
  const bool close = rival && std::abs(sequence_->log_likelihood - *rival) < kClearDifference;
  if (shape_ == PathShape::kLine || !close)
    others_.clear();
  else if (sequence_->settled && others_.empty() && isMuchMore(samples.size(), searched_at_)) {
    searched_at_ = samples.size();
    others_.push_back(sequenceStart(samples, fit_, arc_, config_));
    for (const Arc& start : typicalCircles(samples, arc_, config_.prior.door_radius))
      others_.push_back(sequenceStart(samples, fit_, start, config_));
  }
  return {sequence_->log_likelihood, sequence_->settled && others_.empty()};
}

/// An earlier sequence fit may be caught in an optimum that other poses meanwhile made a bad one.
void ArcModel::startFromFitIfBetter(const PoseSamples& samples) {
  const SequenceFit start = sequenceStart(samples, fit_, arc_, config_);
  const SequenceFit fresh = sequenceFit(samples, start, FitEffort::continued(0));
  if (fresh.log_likelihood > sequence_->log_likelihood) sequence_ = fresh;
}

void ArcModel::tryOtherStart(const PoseSamples& samples, int steps) {
  SequenceFit& other = others_.back();
  other = sequenceFit(samples, other, FitEffort::continued(steps));
  const bool settled = other.settled;
  if (other.log_likelihood > sequence_->log_likelihood) sequence_ = other;
  if (settled) others_.pop_back();
}

Eigen::MatrixXd ArcModel::parameterCovariance(const PoseSequence& track, double correlation) const {
  const Eigen::MatrixXd covariance = covarianceInflation(correlation) * arcCovariance(PoseSamples(track), shape_, fit_, config_);
  Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(9, 9);
  padded.topLeftCorner(covariance.rows(), covariance.cols()) = covariance;
  return padded;
}

}  // namespace cabinet_articulation::core
