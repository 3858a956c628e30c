// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/motion/history.h"

#include <algorithm>

#include "tracking/motion/motion_gate.h"

namespace cabinet_articulation::core {

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
