// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/learner/range_ends.h"

#include <cmath>
#include <cstddef>

namespace cabinet_articulation::core {
namespace {

constexpr double kRest = 0.6;   ///< [s]
constexpr double kNear = 0.03;  ///< of the range: at the end
constexpr double kAway = 0.15;  ///< of the range: left it

bool isEnd(const std::vector<double>& q, const std::vector<double>& stamps, double end, double range) {
  int visits = 0;
  bool away = true;
  double arrived = 0;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const double distance = std::abs(q[i] - end) / range;
    if (distance > kAway) away = true;
    if (distance > kNear) {
      arrived = stamps[i];
      continue;
    }
    if (away) {
      ++visits;
      arrived = stamps[i];
    }
    away = false;
    if (visits > 1 || stamps[i] - arrived >= kRest) return true;
  }
  return false;
}

}  // namespace

RangeEnds seenEnds(const std::vector<double>& q, const std::vector<double>& stamps, double q_min, double q_max) {
  if (!(q_max > q_min)) return {};
  return {isEnd(q, stamps, q_min, q_max - q_min), isEnd(q, stamps, q_max, q_max - q_min)};
}

}  // namespace cabinet_articulation::core
