// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/history.h"

#include <algorithm>

#include "cabinet_articulation/tracking/motion_gate.h"

namespace cabinet_articulation::core {
namespace {
constexpr double kVelocityBase = 0.1;  ///< [s] long enough that noise of millimetres gives centimetres a second
constexpr double kLongestBase = 0.5;   ///< [s] an older observation says nothing about the velocity now
}  // namespace

Rectangle extrapolate(const std::vector<TrackedObservation>& history, double stamp, double horizon) {
  const TrackedObservation& newest = history.back();
  Rectangle predicted = newest.rectangle;
  for (auto older = history.rbegin() + 1; older != history.rend(); ++older) {
    const double base = newest.stamp - older->stamp;
    if (base > kLongestBase) break;
    if (base < kVelocityBase) continue;
    const double ahead = stamp - newest.stamp;
    const double ratio = ahead > 0 ? std::min(ahead, horizon) / base : 0;
    const Eigen::AngleAxisd turn(newest.rectangle.pose.linear() * older->rectangle.pose.linear().transpose());
    predicted.pose.translation() += ratio * (newest.rectangle.center() - older->rectangle.center());
    predicted.pose.linear() = Eigen::AngleAxisd(ratio * turn.angle(), turn.axis()) * newest.rectangle.pose.linear();
    break;
  }
  return predicted;
}

const TrackedObservation& nearestObservation(const std::vector<TrackedObservation>& history, const Eigen::Vector3d& p_fixed) {
  const auto nearer = [&p_fixed](const TrackedObservation& a, const TrackedObservation& b) {
    return (a.rectangle.center() - p_fixed).squaredNorm() < (b.rectangle.center() - p_fixed).squaredNorm();
  };
  return *std::min_element(history.begin(), history.end(), nearer);
}

bool thinOut(std::vector<TrackedObservation>& history, int limit) {
  if (history.size() <= static_cast<size_t>(limit)) return false;
  std::vector<std::pair<double, size_t>> motions;  // of every second observation between its neighbours
  for (size_t i = 1; i < history.size() * 3 / 4; i += 2)
    motions.emplace_back(cornerDistance(history[i - 1].rectangle, history[i + 1].rectangle), i);
  const size_t dropped = std::min<size_t>(motions.size(), limit / 4);
  std::nth_element(motions.begin(), motions.begin() + dropped, motions.end());
  std::vector<bool> drop(history.size(), false);
  for (size_t i = 0; i < dropped; ++i) drop[motions[i].second] = true;
  size_t kept = 0;
  for (size_t i = 0; i < history.size(); ++i)
    if (!drop[i]) history[kept++] = history[i];
  history.resize(kept);
  return true;
}

}  // namespace cabinet_articulation::core
