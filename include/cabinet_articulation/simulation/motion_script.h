// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

namespace cabinet_articulation::core {

/// One joint opens smoothly, stays a moment and closes. Times in s.
struct Move {
  int joint = 0;
  double q_max = 0;
  double start = 1;
  double opening = 2.5;
  double pause = 0.5;
  double closing = 2.5;

  double end() const { return start + opening + pause + closing; }
};

/// Where the hand is: on a joint's handle, or on its way there.
struct HandState {
  int joint = 0;
  double away = 0;  ///< 0: on the handle, 1: just arriving or gone
};

/// All q(t) of a scene as a function of time alone.
class MotionScript {
 public:
  /// Throws std::invalid_argument for a move with a negative duration. `rest` [s] follows the last move.
  explicit MotionScript(std::vector<Move> moves, double rest = 1);

  double duration() const { return duration_; }

  /// 0 before, between and after the moves of the joint.
  double q(int joint, double time) const;

  /// Nothing while no hand is near.
  std::optional<HandState> hand(double time) const;

 private:
  std::vector<Move> moves_;
  double duration_;
};

}  // namespace cabinet_articulation::core
