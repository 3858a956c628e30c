// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/decision/motion_detection.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "articulation/decision/front_prior.h"
#include "articulation/observations/observation_covariance.h"
#include "articulation/observations/pose_jitter.h"
#include "geometry/cross_matrix.h"
#include "geometry/median.h"
#include "geometry/turn_between.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kArmWidth = 0.09;        ///< [m] what is narrower may be an arm
constexpr double kClutterSize = 0.2;      ///< [m] a few of what is smaller may be a face of something that lies about
constexpr double kLongestPause = 0.3;     ///< [s] between a few of them; arms and hands are seen now and then
constexpr std::size_t kCovariances = 50;  ///< observations enough for a mean

constexpr double kLargestGap = 0.7;  ///< largest unobserved share of the travelled range
constexpr double kQuick = 0.5;       ///< [s] within which a hand hardly turns round

constexpr std::size_t kNarrowPoses = 20;  ///< for more than an arm's passing

/// Largest share of the variation that may go back and forth. Measured: 0.3 to 1.4 of faces of clutter that tilt, less than 0.03
/// of fronts that open.
constexpr double kRestless = 0.25;

/// By steps that lead back where the step before came from. A front that is moved, however unevenly, makes hardly any from one
/// frame to the next. Of frames far apart nothing can be said.
double jitterOf(const PoseSequence& poses, const Eigen::Vector3d& point) {
  std::vector<double> back;
  const std::size_t stride = std::max<std::size_t>(1, poses.size() / kJitterTriples);
  for (std::size_t i = 1; i + 1 < poses.size(); i += stride) {
    if (poses.stamps[i + 1] - poses.stamps[i - 1] > 2 * kQuick) continue;
    const Eigen::Vector3d here = poses.poses[i] * point;
    const Eigen::Vector3d step = here - poses.poses[i - 1] * point, next = poses.poses[i + 1] * point - here;
    back.push_back(stepBack(step, next));
  }
  return sigmaOfStepsBack(std::move(back));
}

/// Of the front, relative to its reference point, which is the first of the outline; the corners follow.
Eigen::Vector3d centerOf(const std::vector<Eigen::Vector3d>& outline) {
  const Eigen::Vector3d sum = std::accumulate(outline.begin(), outline.end(), Eigen::Vector3d(0, 0, 0));
  return sum / std::max<double>(1, static_cast<double>(outline.size()) - 1);
}

/// Largest share of the way along which nothing was seen.
double largestGap(const ModelResiduals& residuals) {
  const double range = residuals.q_max - residuals.q_min;
  std::vector<double> places;
  for (const double q : residuals.q)
    if (q >= residuals.q_min && q <= residuals.q_max) places.push_back(q);
  std::sort(places.begin(), places.end());
  double gap = 0;
  for (std::size_t i = 1; i < places.size(); ++i) gap = std::max(gap, places[i] - places[i - 1]);
  return range > 0 ? gap / range : 1;
}

/// Root mean square distance of a point from where the model predicts it, each cut at `limit`.
double spreadOf(const ModelResiduals& residuals, const PoseSequence& poses, const Eigen::Vector3d& point, double limit) {
  double sum = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Vector3d lever = poses.poses[i].linear() * point;
    sum += std::min(limit * limit, (residuals.position[i] + residuals.orientation[i].cross(lever)).squaredNorm());
  }
  return std::sqrt(sum / static_cast<double>(poses.size()));
}

/// Median share of the edges seen, where along the way it is best: a front that stands wide open may hardly be seen.
double edgeSupport(const ModelResiduals& residuals, const PoseSequence& poses) {
  constexpr int kParts = 3;
  constexpr std::size_t kEnough = 3;
  std::array<std::vector<double>, kParts> parts;
  std::vector<double> all;
  const double range = residuals.q_max - residuals.q_min;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!std::isfinite(poses.edge_support[i])) continue;
    const double way = range > 0 ? std::clamp((residuals.q[i] - residuals.q_min) / range, 0.0, 1.0) : 0;
    parts[std::min(kParts - 1, static_cast<int>(kParts * way))].push_back(poses.edge_support[i]);
    all.push_back(poses.edge_support[i]);
  }
  double best = median(std::move(all));
  for (std::vector<double>& part : parts)
    if (part.size() >= kEnough) best = std::max(best, median(std::move(part)));
  return best;
}

/// How much places along the way go back and forth from one pose to the next, as a share of how they vary. That is 1 for white
/// noise, 0.4 where noise has a correlation of a half, and 0 for a one-way motion, however uneven. Of poses that are far apart
/// nothing can be said: there and back may be two motions.
double restlessness(const ModelResiduals& residuals, const PoseSequence& poses) {
  constexpr double kOfWhiteNoise = 1.218;  // mean of max(0, -a b) for successive steps a, b of white noise of unit variance
  double back = 0, mean = 0, square = 0;
  int triples = 0, n = 0;
  std::size_t last = 0, before = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double q = residuals.q[i];
    if (residuals.displaced[i] > kOutlierSigmas || q < residuals.q_min || q > residuals.q_max) continue;
    if (n > 1 && poses.stamps[i] - poses.stamps[before] <= 2 * kQuick) {
      back += std::max(0.0, -(q - residuals.q[last]) * (residuals.q[last] - residuals.q[before]));
      ++triples;
    }
    before = last;
    last = i;
    ++n;
    const double off = q - mean;
    mean += off / n;
    square += off * (q - mean);
  }
  return triples > 0 && square > 0 ? back / triples / (kOfWhiteNoise * square / n) : 0;
}

bool isSmall(const Track& track) { return std::max(track.width, track.height) < kClutterSize && track.width > 0; }

bool isNarrow(const Track& track) { return std::min(track.width, track.height) < kArmWidth && track.width > 0; }

/// An arm comes from somewhere: one of its edges is never seen.
bool lacksAnEdge(const Track& track) {
  constexpr float kSeen = 0.3F;
  for (int edge = 0; edge < 4; ++edge) {
    const auto seen = [edge](const TrackedObservation& observation) { return observation.edge_support[edge] > kSeen; };
    if (std::none_of(track.observations.begin(), track.observations.end(), seen)) return true;
  }
  return false;
}

bool pauses(const PoseSequence& poses) {
  for (std::size_t i = 1; i < poses.size(); ++i)
    if (poses.stamps[i] - poses.stamps[i - 1] > kLongestPause) return true;
  return false;
}

/// Of the observations that say how certain they are.
Matrix6d meanCovariance(const Track& track, const ArticulationConfig& config) {
  Matrix6d sum = Matrix6d::Zero();
  int count = 0;
  const std::size_t stride = std::max<std::size_t>(1, track.observations.size() / kCovariances);
  for (std::size_t i = 0; i < track.observations.size(); i += stride) {
    if (!reportsNoise(track.observations[i])) continue;
    sum += totalCovariance(track.observations[i], config);
    ++count;
  }
  return sum / std::max(1, count);
}

}  // namespace

MotionDetector::MotionDetector(const Track& track, const PoseSequence& poses, const ArticulationConfig& config)
    : config_(config), few_(poses.size() < kFewPoses), covariance_(meanCovariance(track, config)) {
  refused_ = poses.size() < static_cast<std::size_t>(config.observations_min) || (few_ && (pauses(poses) || isSmall(track))) ||
             (isNarrow(track) && (poses.size() < kNarrowPoses || lacksAnEdge(track)));
  for (const Eigen::Vector3d& point : poses.outline) jitter_.push_back(jitterOf(poses, point));
  if (few_) one_front_ = oddsOfOneFront(track, poses.size(), config.prior);
}

bool MotionDetector::isSteady(const ModelResiduals& residuals, const PoseSequence& poses) const {
  return !refused_ && restlessness(residuals, poses) <= kRestless;
}

bool MotionDetector::passes(const ArticulationModel& model, const ModelResiduals& residuals, const PoseSequence& poses) const {
  if (!isSteady(residuals, poses) || largestGap(residuals) > kLargestGap) return false;
  const double seen = clarity(edgeSupport(residuals, poses));
  for (std::size_t k = 0; k < poses.outline.size(); ++k) {
    const double path = model.pathLength(residuals.q_min, residuals.q_max, poses.outline[k]);
    if (path >= config_.motion_min && standsOut(seen * path, k, residuals, poses)) return true;
  }
  return false;
}

double MotionDetector::earlyLogOdds(const ArticulationModel& model, const ModelResiduals& residuals,
                                    const PoseSequence& poses) const {
  constexpr double kNever = -std::numeric_limits<double>::infinity();
  if (!few_ || covariance_.isZero(0) || !isSteady(residuals, poses)) return kNever;
  // Few poses have no spread that a motion could stand out of.
  if (edgeSupport(residuals, poses) < config_.edge_support_min) return kNever;
  if (poses.size() > 2 && largestGap(residuals) > kLargestGap) return kNever;
  const Eigen::Isometry3d first = model.predict(residuals.q_min), last = model.predict(residuals.q_max);
  // Planes that are taken for one another turn at once.
  if (turnBetween(first, last) > config_.prior.hand_turn_rate * (poses.stamps.back() - poses.stamps.front())) return kNever;
  double farthest = 0;
  const Eigen::Vector3d center = centerOf(poses.outline);
  for (std::size_t k = 0; k < poses.outline.size(); ++k) {
    const Eigen::Vector3d way = last * poses.outline[k] - first * poses.outline[k];
    if (!standsOut(way.norm(), k, residuals, poses)) continue;
    farthest = std::max(farthest, significance(way, last.linear() * (poses.outline[k] - center)));
  }
  return farthest > 0 ? std::min(0.5 * farthest * farthest, one_front_) - std::log(config_.prior.rest_odds) : kNever;
}

/// Factor of a path that counts where only so much of the edges was seen: clutter and arms end nowhere, and seem to move.
double MotionDetector::clarity(double edge_support) const {
  constexpr double kPower = 4;  // with half of edge_support_min a path must stand out 16 times as much (ours)
  return std::pow(std::min(1.0, edge_support / config_.edge_support_min), kPower);
}

/// Mahalanobis distance between two observations of a point that is `lever` away from the front's centre.
double MotionDetector::significance(const Eigen::Vector3d& way, const Eigen::Vector3d& lever) const {
  Eigen::Matrix<double, 3, 6> motion;  // of the point with the front's pose
  motion << Eigen::Matrix3d::Identity(), crossMatrix(-lever);
  const Eigen::Matrix3d covariance = 2 * motion * covariance_ * motion.transpose();
  return std::sqrt(way.dot(covariance.inverse() * way));
}

/// Is the path of a point of the outline much longer than its jitter, and than its distance from where the model says?
bool MotionDetector::standsOut(double path, std::size_t point, const ModelResiduals& residuals, const PoseSequence& poses) const {
  return path >= config_.motion_to_jitter * jitter_[point] &&
         path >= config_.motion_to_noise * spreadOf(residuals, poses, poses.outline[point], outlierDistance(poses, config_));
}

}  // namespace cabinet_articulation::core
