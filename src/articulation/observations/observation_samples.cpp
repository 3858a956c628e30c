// SPDX-License-Identifier: BSD-3-Clause
// The poses that ObservationHistory gives.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "articulation/observations/observation_history.h"

namespace cabinet_articulation::core {

PoseSequence ObservationHistory::evenlySpaced(ReferencePoint point, std::size_t count) const {
  std::vector<std::size_t> indices;
  const auto add = [&indices](std::size_t i) { indices.push_back(i); };
  if (entries_.size() <= count) {
    for (std::size_t i = 0; i < entries_.size(); ++i) add(i);
    return picked(point, indices);
  }
  double stride = 1;
  while (entries_.back().place > static_cast<double>(count - 2) * stride) stride *= 2;
  for (std::size_t i = 0; i < entries_.size(); ++i)
    if (i == 0 || std::floor(entries_[i].place / stride) > std::floor(entries_[i - 1].place / stride)) add(i);
  // The newest takes the place of the one before until that is a place of its own.
  if (indices.back() + 1 != entries_.size()) add(entries_.size() - 1);
  return picked(point, indices);
}

PoseSequence ObservationHistory::runs(ReferencePoint point, std::size_t count) const {
  constexpr std::size_t kRun = 20;
  const std::size_t runs = count / kRun;
  if (entries_.size() <= count || runs < 2) return evenlySpaced(point, count);
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
  const double way = entries_[last].way - entries_.front().way;
  const auto progress = [&](std::size_t i) {
    const double of_time = static_cast<double>(i) / static_cast<double>(last);
    return way > 0 ? (of_time + (entries_[i].way - entries_.front().way) / way) / 2 : of_time;
  };
  std::vector<std::size_t> starts;
  std::size_t i = 0;
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
  const auto first = std::upper_bound(entries_.begin(), entries_.end(), stamp, later);
  std::vector<std::size_t> indices(static_cast<std::size_t>(entries_.end() - first));
  std::iota(indices.begin(), indices.end(), static_cast<std::size_t>(first - entries_.begin()));
  return picked(point, indices);
}

PoseSequence ObservationHistory::withLeftOut(ReferencePoint point, std::size_t count) const {
  const std::size_t all = left_out_.size() + entries_.size(), stride = 1 + (all - 1) / count;
  std::vector<const Entry*> entries;
  for (std::size_t i = 0; i < all; i += stride)
    entries.push_back(i < left_out_.size() ? &left_out_[i] : &entries_[i - left_out_.size()]);
  return described(point, entries);
}

PoseSequence ObservationHistory::picked(ReferencePoint point, const std::vector<std::size_t>& indices) const {
  std::vector<const Entry*> entries;
  for (const std::size_t i : indices) entries.push_back(&entries_[i]);
  return described(point, entries);
}

PoseSequence ObservationHistory::described(ReferencePoint point, const std::vector<const Entry*>& entries) const {
  PoseSequence track;
  track.has_orientation = config_.use_orientation;
  track.is_marker = size_.minCoeff() <= 0;
  track.position_jitter = jitter_.position;
  track.orientation_jitter = jitter_.orientation;
  // Only of rectangles is it known how they lie in space: a marker may be stuck on any way round.
  if (size_.minCoeff() > 0) track.hinge = {config_.prior.sigma_hinge, -point.offset(size_.x(), size_.y()), size_ / 2};
  track.stamps.reserve(entries.size());
  track.poses.reserve(entries.size());
  track.edge_support.reserve(entries.size());
  for (const Entry* seen : entries) {
    const Entry& entry = *seen;
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
