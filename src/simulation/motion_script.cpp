// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/simulation/motion_script.h"

#include <algorithm>
#include <stdexcept>

namespace cabinet_articulation::core {
namespace {

constexpr double kApproach = 0.8;  ///< [s] a hand needs to arrive or to leave

/// 0 to 1 with vanishing velocity and acceleration at both ends.
double smoothStep(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * x * (10 + x * (6 * x - 15));
}

double ramp(double time, double start, double length) { return length > 0 ? (time - start) / length : (time >= start ? 1 : 0); }

}  // namespace

MotionScript::MotionScript(std::vector<Move> moves, double rest) : moves_(std::move(moves)), duration_(rest) {
  for (const Move& move : moves_) {
    if (move.opening < 0 || move.pause < 0 || move.closing < 0)
      throw std::invalid_argument("a move of joint " + std::to_string(move.joint) + " has a negative duration");
    duration_ = std::max(duration_, move.end() + rest);
  }
}

double MotionScript::q(int joint, double time) const {
  double q = 0;
  for (const Move& move : moves_)
    if (move.joint == joint)
      q += move.q_max * (smoothStep(ramp(time, move.start, move.opening)) -
                         smoothStep(ramp(time, move.start + move.opening + move.pause, move.closing)));
  return q;
}

std::optional<HandState> MotionScript::hand(double time) const {
  for (const Move& move : moves_) {
    const double away = std::max({0.0, (move.start - time) / kApproach, (time - move.end()) / kApproach});
    if (away < 1) return HandState{move.joint, smoothStep(away)};
  }
  return std::nullopt;
}

}  // namespace cabinet_articulation::core
