// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/models/screw_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "articulation/paths/arc.h"
#include "geometry/cross_matrix.h"
#include "geometry/median.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kLeastNoise = 1e-4;  ///< [m] of positions, where a model does not say
constexpr int kFreshRounds = 4;
constexpr int kStepsOfRound = 4;

/// `turn` is known but for whole turns, which the advance tells with its noise, and the turns before, `least` to `most`.
double mostLikelyTurn(double turn, double advance, double pitch, double noise, double least, double most) {
  constexpr double kRound = 2 * M_PI, kBeyond = M_PI / 2;  // [rad]; kBeyond: as far as a front may go on between two poses
  const double margin = kRound + (most - least) / 2;
  double best = turn, least_cost = std::numeric_limits<double>::infinity();
  const double first = std::ceil((least - margin - turn) / kRound), last = std::floor((most + margin - turn) / kRound);
  for (double round = first; round <= last; ++round) {
    const double candidate = turn + kRound * round, outside = std::max({0.0, least - candidate, candidate - most});
    const double cost = std::pow((advance - pitch * candidate) / noise, 2) + std::pow(outside / kBeyond, 2);
    if (cost >= least_cost) continue;
    best = candidate;
    least_cost = cost;
  }
  return best;
}

}  // namespace

double ScrewModel::logPrior() const {
  return std::log(config_.prior.screw_share) - 0.5 * std::pow(pitch_.value / config_.prior.screw_pitch, 2);
}

/// The odds that the pitch, as far as the noise tells it, is not 0: the integral over its prior beside the likelihood of none.
double ScrewModel::largestAdvantage() const {
  const double prior_variance = std::pow(config_.prior.screw_pitch, 2);
  return std::log(config_.prior.screw_share) + 0.5 * pitch_.value * pitch_.value / pitch_.variance -
         0.5 * std::log(prior_variance / pitch_.variance);
}

bool ScrewModel::fit(const PoseSequence& track, const WorkBudget& budget) {
  const bool continues = fitted_ && with_orientation_ == track.has_orientation && !budget.isUnlimited();
  if (!continues && !fitAnew(track)) return false;
  std::vector<double> turns = unwrappedTurns(track);
  if (!continues) {
    fitPitch(track, turns);
    // Hardly a pitch: a door.
    for (int round = 1; round < kFreshRounds && largestAdvantage() >= 0; ++round) {
      fitTurn(track, WorkBudget::ofSteps(kStepsOfRound), &turns);
      fitPitch(track, turns);
    }
  } else if (std::exchange(turns_next_, !turns_next_)) {
    fitTurn(track, budget, &turns);
  } else {
    fitPitch(track, turns);
  }
  orient(track, turns);
  return true;
}

bool ScrewModel::fitAnew(const PoseSequence& track) {
  if (!std::exchange(has_start_, false) && !turning_.fit(track, WorkBudget::unlimited())) return false;
  with_orientation_ = track.has_orientation;
  turns_next_ = false;
  return fitted_ = true;
}

void ScrewModel::fitTurn(const PoseSequence& track, const WorkBudget& budget, std::vector<double>* turns) {
  turning_.fit(withoutAdvance(track, *turns), budget);
  *turns = unwrappedTurns(track);
  findShift(track, *turns);
}

void ScrewModel::fitPitch(const PoseSequence& track, const std::vector<double>& turns) {
  pitch_ = bestPitch(track, turns);
  findShift(track, turns);
}

void ScrewModel::startFrom(const ArticulationModel& fitted) {
  const auto* turning = dynamic_cast<const RotationalModel*>(&fitted);
  if (!turning) return;
  turning_ = *turning;
  has_start_ = true;
}

/// [m] How far the pose is along the axis from where the turn alone would put it.
double ScrewModel::offAlongAxis(const Eigen::Isometry3d& pose, double turn) const {
  return turning_.geometry().axis.dot(pose.translation() - turning_.predict(turn).translation());
}

double ScrewModel::turnOf(const Eigen::Isometry3d& pose, double least, double most) const {
  const double turn = turning_.configuration(pose);
  return mostLikelyTurn(turn, offAlongAxis(pose, turn) - shift_, pitch_.value, turning_.positionNoise(), least, most);
}

/// Successive poses are less than half a turn apart.
std::vector<double> ScrewModel::unwrappedTurns(const PoseSequence& track) const {
  std::vector<double> turns;
  for (const Eigen::Isometry3d& pose : track.poses) {
    const double turn = turning_.configuration(pose);
    turns.push_back(turns.empty() ? turn : turns.back() + std::remainder(turn - turns.back(), 2 * M_PI));
  }
  return turns;
}

/// Beyond one turn, a pose is next to the one before: the advance alone may be less than the noise.
std::vector<double> ScrewModel::turnsOf(const PoseSequence& track) const {
  std::vector<double> turns;
  for (const Eigen::Isometry3d& pose : track.poses) {
    const bool follows = most_ - least_ > 2 * M_PI && !turns.empty();
    turns.push_back(follows ? turnOf(pose, turns.back(), turns.back()) : turnOf(pose, least_, most_));
  }
  return turns;
}

std::vector<double> ScrewModel::configurations(const PoseSequence& track) const {
  std::vector<double> q = turnsOf(track);
  for (double& value : q) value = direction_ * (value - first_);
  return q;
}

PoseSequence ScrewModel::withoutAdvance(const PoseSequence& track, const std::vector<double>& turns) const {
  const Eigen::Vector3d axis = turning_.geometry().axis;
  PoseSequence turned = track;
  for (std::size_t i = 0; i < track.size(); ++i) turned.poses[i].pretranslate(-advance(turns[i]) * axis);
  return turned;
}

/// By robust linear least squares about the last fit.
PitchEstimate ScrewModel::bestPitch(const PoseSequence& track, const std::vector<double>& turns) const {
  const JointGeometry geometry = turning_.geometry();
  const Eigen::Vector3d e1 = geometry.axis.unitOrthogonal(), e2 = geometry.axis.cross(e1);
  const bool weighted = track.has_orientation && !track.position_weights.empty();
  PitchFit fit(config_.prior.screw_pitch);
  PitchFit::Row row;
  for (std::size_t i = 0; i < track.size(); ++i) {
    const Eigen::Isometry3d& pose = track.poses[i];
    const Eigen::Vector3d lever = (pose.translation() - geometry.axis_point).cross(geometry.axis);
    row << 1, e1.dot(lever), e2.dot(lever), 0, 0, turns[i];
    const double seen = weighted ? (track.position_weights[i] * geometry.axis).squaredNorm() : 1;
    fit.addPosition(offAlongAxis(pose, turns[i]), row, seen);
    if (!track.has_orientation) continue;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(turns[i], geometry.axis).toRotationMatrix();
    const Eigen::Matrix3d away = pose.linear() * turning_.predict(turns[i]).linear().transpose();
    const Eigen::Vector3d turned = rotationVector(Eigen::Quaterniond(away));
    for (const Eigen::Vector3d& e : {e1, e2}) {
      row << 0, e.dot(e1 - turn * e1), e.dot(e2 - turn * e2), e.dot(turn * e1), e.dot(turn * e2), 0;
      fit.addOrientation(e.dot(turned), row, weighted ? (track.orientation_weights[i] * e).squaredNorm() : 1);
    }
  }
  return fit.solve(config_.degrees_of_freedom);
}

void ScrewModel::findShift(const PoseSequence& track, const std::vector<double>& turns) {
  std::vector<double> shifts;
  for (std::size_t i = 0; i < track.size(); ++i)
    shifts.push_back(offAlongAxis(track.poses[i], turns[i]) - pitch_.value * turns[i]);
  shift_ = median(shifts);
}

void ScrewModel::orient(const PoseSequence& track, const std::vector<double>& turns) {
  const double limit = outlierDistance(track, config_);
  std::vector<double> near;
  const Eigen::Vector3d axis = turning_.geometry().axis;
  for (std::size_t i = 0; i < track.size(); ++i) {
    const Eigen::Vector3d predicted = turning_.predict(turns[i]).translation() + advance(turns[i]) * axis;
    if ((track.poses[i].translation() - predicted).norm() <= limit) near.push_back(turns[i]);
  }
  if (near.empty()) near.push_back(turns.front());
  const auto [least, most] = std::minmax_element(near.begin(), near.end());
  least_ = *least;
  most_ = *most;
  first_ = near.front();
  direction_ = most_ - first_ >= first_ - least_ ? 1 : -1;
}

Eigen::Isometry3d ScrewModel::predict(double q) const {
  const double turn = first_ + direction_ * q;
  return Eigen::Translation3d(advance(turn) * turning_.geometry().axis) * turning_.predict(turn);
}

double ScrewModel::configuration(const Eigen::Isometry3d& pose) const {
  return direction_ * (turnOf(pose, least_, most_) - first_);
}

JointGeometry ScrewModel::geometry() const {
  JointGeometry geometry = turning_.geometry();
  geometry.axis_point += advance(first_) * geometry.axis;
  geometry.axis *= direction_;
  geometry.pitch = pitch_.value;
  return geometry;
}

Matrix6d ScrewModel::covariance(const PoseSequence& track, const Eigen::Vector3d& p, double correlation) const {
  return turning_.covariance(withoutAdvance(track, unwrappedTurns(track)), p, correlation);
}

std::vector<ModelParam> ScrewModel::parameters() const {
  std::vector<ModelParam> params = turning_.parameters();
  params.push_back({"screw_pitch", pitch_.value, ModelParam::kParam});
  return params;
}

SequenceProgress ScrewModel::sequenceLogLikelihood(const PoseSequence& track, const WorkBudget& budget,
                                                   std::optional<double> rival) {
  return turning_.sequenceLogLikelihood(withoutAdvance(track, turnsOf(track)), budget, rival);
}

Eigen::Isometry3d ScrewModel::predictLearned(const LearnedModel& model, double q) {
  return Eigen::Translation3d(model.pitch * q * model.axis) * RotationalModel::predictLearned(model, q);
}

double ScrewModel::configurationOfLearned(const LearnedModel& model, const Eigen::Isometry3d& front) {
  const double turn = RotationalModel::configurationOfLearned(model, front);
  const double off = model.axis.dot(front.translation() - model.origin.translation());
  const double noise = std::max(model.position_error, kLeastNoise);
  return mostLikelyTurn(turn, off, model.pitch, noise, model.q_min, model.q_max);
}

Matrix6d ScrewModel::jacobianOfLearned(const LearnedModel& model, double q) {
  Matrix6d J = RotationalModel::jacobianOfLearned(model, q);
  J.topRightCorner<3, 3>() -= model.pitch * (q - (model.q_min + model.q_max) / 2) * crossMatrix(model.axis);
  return J;
}

LearnedModel ScrewModel::example() {
  LearnedModel screw = RotationalModel::example();
  screw.type = kTraits.type;
  screw.pitch = 0.008;
  screw.q_max = 8;  // more than a turn
  return screw;
}

}  // namespace cabinet_articulation::core
