// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/observations/observation_history.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "articulation/observations/observation_covariance.h"

namespace cabinet_articulation::core {
namespace {

/// Poses at rest that say as much as poses on the way (ours). Of more, each says less than the one before, so that no rest,
/// however long, outweighs a motion.
constexpr double kShortRest = 100;

bool isRotation(const Eigen::Matrix3d& R) {
  return (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-3 && R.determinant() > 0;
}

/// sigma covariance^(-1/2): a deviation weighs as much as it would with noise of that sigma in every direction.
Eigen::Matrix3d weightOf(const Eigen::Matrix3d& covariance, double sigma) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  const Eigen::Vector3d variances = solver.eigenvalues().cwiseMax(1e-12);
  return sigma * solver.eigenvectors() * variances.array().rsqrt().matrix().asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace

void ObservationHistory::append(const TrackedObservation& observation, std::vector<Entry>* entries) {
  const Rectangle& rectangle = observation.rectangle;
  if (!std::isfinite(observation.stamp)) return;
  if (!std::isfinite(rectangle.width) || !std::isfinite(rectangle.height)) return;
  if (!rectangle.pose.matrix().allFinite() || !isRotation(rectangle.pose.linear())) return;
  const auto& support = observation.edge_support;
  Entry entry{observation.stamp,
              rectangle.pose,
              rectangle.width,
              rectangle.height,
              std::accumulate(support.begin(), support.end(), 0.0F) / 4,
              false,
              Eigen::Matrix3d::Identity(),
              Eigen::Matrix3d::Identity()};
  entry.weighted = reportsNoise(observation);
  if (entry.weighted) {
    const Matrix6d covariance = weighingCovariance(observation, config_);
    entry.position_weight = weightOf(covariance.topLeftCorner<3, 3>(), config_.sigma_plane);
    entry.orientation_weight = weightOf(covariance.bottomRightCorner<3, 3>(), config_.sigma_orientation);
  }
  if (!entry.weighted) {
    const AmbiguousTurns::Resolved resolved = turns_.resolve(entry.center);
    entry.center = resolved.pose;
    if (resolved.swaps_sides) std::swap(entry.width, entry.height);
  }
  entries->push_back(entry);
}

/// Whatever description the first pose came in, the most frequent one is right.
void ObservationHistory::redescribe(const AmbiguousTurns::Description& description, std::vector<Entry>* entries) {
  for (Entry& entry : *entries) {
    if (entry.weighted) continue;
    entry.center = description(entry.center);
    if (description.swapsSides()) std::swap(entry.width, entry.height);
  }
  turns_.redescribe(description);
}

/// Index of the first observation that is new. Nothing if this is another track than that of the last update.
std::optional<std::size_t> ObservationHistory::firstNew(const Track& track) const {
  const std::vector<TrackedObservation>& all = track.observations;
  if (observations_ == 0 || all.empty() || track.revision != revision_ || all.front().stamp != first_stamp_) return std::nullopt;
  if (all.size() >= observations_ && all[observations_ - 1].stamp == last_stamp_) return observations_;
  const auto known = [this](const TrackedObservation& observation) { return observation.stamp == last_stamp_; };
  const auto newest = std::find_if(all.rbegin(), all.rend(), known);
  if (newest == all.rend()) return std::nullopt;
  return static_cast<std::size_t>(newest.base() - all.begin());
}

void ObservationHistory::removeWhatIsNotIn(const Track& track) {
  std::vector<double> stamps;
  for (const TrackedObservation& observation : track.observations) stamps.push_back(observation.stamp);
  std::sort(stamps.begin(), stamps.end());
  const auto gone = [&stamps](const Entry& entry) { return !std::binary_search(stamps.begin(), stamps.end(), entry.stamp); };
  entries_.erase(std::remove_if(entries_.begin(), entries_.end(), gone), entries_.end());
}

void ObservationHistory::findFirst() {
  const auto earlier = [](const Entry& entry, double stamp) { return entry.stamp < stamp; };
  first_ = static_cast<std::size_t>(std::lower_bound(entries_.begin(), entries_.end(), not_before_, earlier) - entries_.begin());
}

void ObservationHistory::leaveOutBefore(double stamp) {
  not_before_ = stamp;
  findFirst();
}

bool ObservationHistory::update(const Track& track) {
  const std::optional<std::size_t> continued = firstNew(track);
  std::vector<Entry> fresh;
  if (!continued) turns_ = AmbiguousTurns(config_.sigma_position, config_.sigma_orientation);
  for (std::size_t i = continued.value_or(0); i < track.observations.size(); ++i) append(track.observations[i], &fresh);
  if (!continued) {
    const auto is_left_out = [this](const Entry& entry) { return entry.stamp < not_before_; };
    if (std::all_of(fresh.begin(), fresh.end(), is_left_out)) return false;
    redescribe(turns_.most(), &fresh);
    entries_.clear();
  } else if (*continued < observations_) {
    removeWhatIsNotIn(track);
  }
  entries_.insert(entries_.end(), fresh.begin(), fresh.end());
  const auto earlier = [](const Entry& a, const Entry& b) { return a.stamp < b.stamp; };
  const bool in_order = std::is_sorted(entries_.begin(), entries_.end(), earlier);
  if (!in_order) std::stable_sort(entries_.begin(), entries_.end(), earlier);
  findFirst();
  if (size() == 0) return false;
  measureWay(continued && in_order ? entries_.size() - fresh.size() : 0);
  weighted_ = config_.use_orientation &&
              std::any_of(entries_.begin() + first_, entries_.end(), [](const Entry& entry) { return entry.weighted; });
  measureJitter(continued.has_value());
  size_ << track.width, track.height;
  revision_ = track.revision;
  observations_ = track.observations.size();
  first_stamp_ = track.observations.front().stamp;
  last_stamp_ = track.observations.back().stamp;
  return true;
}

double ObservationHistory::sizeDeviation() const {
  const double n = static_cast<double>(size());
  Eigen::Array2d mean = Eigen::Array2d::Zero(), deviation = mean;
  const auto measured = [this](std::size_t i) { return Eigen::Array2d(entries_[i].width, entries_[i].height); };
  for (std::size_t i = first_; i < entries_.size(); ++i) mean += measured(i) / n;
  for (std::size_t i = first_; i < entries_.size(); ++i) deviation += (measured(i) - mean).abs() / n;
  return deviation.maxCoeff();
}

void ObservationHistory::measureWay(std::size_t from) {
  if (from == 0) way_anchor_ = rest_anchor_ = entries_.front().center.translation();
  for (std::size_t i = from; i < entries_.size(); ++i) {
    const double step = (entries_[i].center.translation() - way_anchor_).norm();
    const double way = i > 0 ? entries_[i - 1].way : 0, rested = i > 0 ? entries_[i - 1].rested : 0;
    Entry& entry = entries_[i];
    const bool goes_on = step >= config_.sigma_position;
    entry.way = way + (goes_on ? step : 0);
    if (goes_on) way_anchor_ = entry.center.translation();
    const bool rests = (entry.center.translation() - rest_anchor_).norm() < 3 * config_.sigma_position;
    entry.rested = rests ? rested + 1 : 0;
    if (!rests) rest_anchor_ = entry.center.translation();
    entry.place = i > 0 ? entries_[i - 1].place + 1 / (1 + entry.rested / kShortRest) : 0;
  }
}

/// Again where a tenth more is known.
void ObservationHistory::measureJitter(bool continues) {
  if (continues && size() >= jitter_measured_at_ && 10 * size() < 11 * jitter_measured_at_) return;
  jitter_measured_at_ = size();
  jitter_ = weighted_ ? PoseJitter() : jitterOf(size(), [this](std::size_t i) { return entries_[first_ + i].center; });
}

}  // namespace cabinet_articulation::core
