// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/arc_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cabinet_articulation/articulation/arc_start.h"

namespace cabinet_articulation::core {
namespace {

/// [nats] Differences in likelihood above which no other local optimum will turn the answer (measured: 24 was turned).
constexpr double kClear = 40;

/// Fits to fewer poses may be far from the truth, so that the next starts anew.
constexpr std::size_t kFew = 12;

}  // namespace

bool ArcModel::fit(const PoseTrack& track) {
  if (track.size() < (shape_ == PathShape::kLine || track.has_orientation ? 2u : 3u)) return false;
  const PoseSamples samples(track);
  const bool known = fitted_to_ >= kFew && with_orientation_ == track.has_orientation;
  with_orientation_ = track.has_orientation;
  fit_ =
      known ? fitArc(samples, shape_, arc_, config_, FitEffort::kContinued) : fitArc(samples, shape_, startOf(samples), config_);
  arc_ = fit_.arc;
  orient(samples);
  fitted_to_ = track.size();
  return true;
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
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (arc_.squaredDistance(samples.positions[i]) > 9 * config_.sigma_position * config_.sigma_position) continue;
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
  // Close to the axis the orientation says better than the position how far the front has turned.
  if (2.5 * ratio > 1) s = turnAt(0) / arc_.curvature;
  const Eigen::Isometry3d predicted = arc_.pose(s);
  const Eigen::Vector3d tangent = Eigen::AngleAxisd(arc_.curvature * s, arc_.axis()) * arc_.tangent();
  const double along = tangent.dot(pose.translation() - predicted.translation());
  return s + (along + ratio * ratio * turnAt(s) / arc_.curvature) / (1 + ratio * ratio);
}

double ArcModel::configuration(const Eigen::Isometry3d& pose) const { return (arcLength(pose) - first_) * unit(); }

double ArcModel::sequenceLogLikelihood(const PoseTrack& track, std::optional<double> rival) {
  const PoseSamples samples(track);
  if (samples.size() < kFew) sequence_start_.reset();
  SequenceFit best = fitArcSequence(samples, shape_, fit_, sequence_start_.value_or(arc_), rival, config_);
  const auto tryStart = [&](const Arc& start) {
    const SequenceFit fit = fitArcSequence(samples, shape_, fit_, start, rival, config_);
    if (fit.log_likelihood > best.log_likelihood) best = fit;
  };
  // Circles have local optima: where it matters, they are looked for from everywhere, and again when there are more poses.
  const bool close = rival && std::abs(best.log_likelihood - *rival) < kClear;
  if (shape_ == PathShape::kCircle && close && samples.size() > searched_at_ + searched_at_ / 4) {
    searched_at_ = samples.size();
    if (sequence_start_) tryStart(arc_);
    for (const Arc& arc : typicalCircles(samples, arc_)) tryStart(arc);
  }
  sequence_start_ = best.arc;
  return best.log_likelihood;
}

Eigen::MatrixXd ArcModel::parameterCovariance(const PoseTrack& track, double correlation) const {
  ArcFit fit = fit_;
  fit.arc = arc_;
  const double inflation = config_.covariance_factor * (1 + correlation) / (1 - correlation);
  const Eigen::MatrixXd covariance = inflation * arcCovariance(PoseSamples(track), shape_, fit, config_);
  Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(9, 9);
  padded.topLeftCorner(covariance.rows(), covariance.cols()) = covariance;
  return padded;
}

}  // namespace cabinet_articulation::core
