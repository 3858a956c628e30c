// SPDX-License-Identifier: BSD-3-Clause
// The poses that ObservationHistory gives.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "articulation/observations/observation_history.h"

namespace cabinet_articulation::core {

PoseSequence ObservationHistory::evenlySpaced(ReferencePoint point, std::size_t count) const {
  return picked(point, indicesAtPlaces(first_, count));
}

PoseSequence ObservationHistory::withLeftOut(ReferencePoint point, std::size_t count) const {
  return picked(point, indicesAtPlaces(0, count));
}

PoseSequence ObservationHistory::alongWholeWay(ReferencePoint point, std::size_t count) const {
  return picked(point, indicesAtSteps(&Entry::way, config_.sigma_position, 0, count));
}

std::vector<std::size_t> ObservationHistory::indicesAtPlaces(std::size_t first, std::size_t count) const {
  if (entries_.size() - first > count) return indicesAtSteps(&Entry::place, 1, first, count);
  std::vector<std::size_t> indices(entries_.size() - first);
  std::iota(indices.begin(), indices.end(), first);
  return indices;
}

/// At most `count` from `first` on, where a measure that grows goes on by `step`, doubled as often as needed.
std::vector<std::size_t> ObservationHistory::indicesAtSteps(double Entry::*measure, double step, std::size_t first,
                                                            std::size_t count) const {
  const auto measured = [&](std::size_t i) { return entries_[i].*measure - entries_[first].*measure; };
  while (measured(entries_.size() - 1) > static_cast<double>(count - 2) * step) step *= 2;
  std::vector<std::size_t> indices{first};
  indices.reserve(count);
  for (std::size_t i = first + 1; i < entries_.size(); ++i)
    if (std::floor(measured(i) / step) > std::floor(measured(i - 1) / step)) indices.push_back(i);
  // The newest takes the place of the one before until that is a place of its own.
  if (indices.back() + 1 != entries_.size()) indices.push_back(entries_.size() - 1);
  return indices;
}

PoseSequence ObservationHistory::runs(ReferencePoint point, std::size_t count) const {
  constexpr std::size_t kRun = 20;  // successive frames, of which the correlation of noise is told (ours)
  const std::size_t runs = count / kRun;
  if (size() <= count || runs < 2) return evenlySpaced(point, count);
  std::vector<std::size_t> indices;
  for (const std::size_t start : runStarts(runs, kRun))
    for (std::size_t i = 0; i < kRun; ++i) indices.push_back(start + i);
  PoseSequence track = picked(point, indices);
  for (std::size_t i = 0; i < indices.size(); ++i) track.run_starts.push_back(i % kRun == 0);
  return track;
}

/// Of runs that do not overlap, the last one at the end. Rest tells of the noise, the way of the joint: either has half a say.
std::vector<std::size_t> ObservationHistory::runStarts(std::size_t runs, std::size_t length) const {
  const std::size_t last = entries_.size() - length;
  const double way = entries_[last].way - entries_[first_].way;
  const auto progress = [&](std::size_t i) {
    const double of_time = static_cast<double>(i - first_) / static_cast<double>(last - first_);
    return way > 0 ? (of_time + (entries_[i].way - entries_[first_].way) / way) / 2 : of_time;
  };
  std::vector<std::size_t> starts;
  std::size_t i = first_;
  for (std::size_t run = 0; run < runs; ++run) {
    const double target = static_cast<double>(run) / static_cast<double>(runs - 1);
    while (i < last && progress(i) < target) ++i;
    const std::size_t room = last - (runs - 1 - run) * length;
    starts.push_back(std::min(i, room));
    i = starts.back() + length;
  }
  return starts;
}

PoseSequence ObservationHistory::since(ReferencePoint point, double stamp) const {
  const auto later = [](double value, const Entry& entry) { return value < entry.stamp; };
  const auto first = std::upper_bound(entries_.begin() + first_, entries_.end(), stamp, later);
  std::vector<std::size_t> indices(static_cast<std::size_t>(entries_.end() - first));
  std::iota(indices.begin(), indices.end(), static_cast<std::size_t>(first - entries_.begin()));
  return picked(point, indices);
}

PoseSequence ObservationHistory::picked(ReferencePoint point, const std::vector<std::size_t>& indices) const {
  PoseSequence track;
  track.has_orientation = config_.use_orientation;
  track.is_marker = size_.minCoeff() <= 0;
  track.position_jitter = jitter_.position;
  track.orientation_jitter = jitter_.orientation;
  // Only of rectangles is it known how they lie in space: a marker may be stuck on any way round.
  if (size_.minCoeff() > 0) track.hinge = {config_.prior.sigma_hinge, -point.offset(size_.x(), size_.y()), size_ / 2};
  track.stamps.reserve(indices.size());
  track.poses.reserve(indices.size());
  track.edge_support.reserve(indices.size());
  for (const std::size_t i : indices) {
    const Entry& entry = entries_[i];
    track.stamps.push_back(entry.stamp);
    track.poses.push_back(entry.center);
    track.poses.back().translate(point.offset(entry.width, entry.height));
    track.edge_support.push_back(entry.edge_support);
    if (!weighted_) continue;
    track.position_weights.push_back(entry.position_weight);
    track.orientation_weights.push_back(entry.orientation_weight);
  }
  return track;
}

std::vector<Eigen::Vector3d> ObservationHistory::outline(ReferencePoint point, double width, double height) const {
  std::vector<Eigen::Vector3d> outline{Eigen::Vector3d::Zero()};
  if (!config_.use_orientation) return outline;
  const double lever = config_.sigma_position / config_.sigma_orientation;
  if (width <= 0 || height <= 0) width = height = 2 * lever;
  for (const int x : {-1, 1})
    for (const int y : {-1, 1}) outline.push_back(ReferencePoint{x, y}.offset(width, height) - point.offset(width, height));
  return outline;
}

}  // namespace cabinet_articulation::core
