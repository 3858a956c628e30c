// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <boost/shared_ptr.hpp>
#include <cmath>
#include <deque>
#include <functional>
#include <optional>
#include <utility>

#include "cabinet_articulation/ros/pose_conversions.h"

namespace cabinet_articulation {

enum class Side { kLeft, kRight };

/// Pairs the messages of two topics by their stamps. While the stamps of each topic grow, the pairs do not depend on how the two
/// interleave. So everyone who hears both comes to the same pairs.
///
/// A message belongs to one pair at most. What arrived before the messages of a pair is given up: it would find a partner only
/// where messages overtake each other. Order is that of arrival, so that a clock that was set back hides nothing.
template <class Message>
class PairMatcher {
 public:
  using Ptr = boost::shared_ptr<const Message>;
  using GiveUp = std::function<void(Side, const Ptr&)>;

  struct Pair {
    Ptr left, right;
  };

  /// The stamps of a pair differ by `tolerance` seconds at most (0: not at all). `give_up` (may be empty) is told of every
  /// message that remains alone.
  explicit PairMatcher(double tolerance, GiveUp give_up = {}) : tolerance_(tolerance), give_up_(std::move(give_up)) {}

  /// The pair that this message completes. Its partner is the first to arrive of those that fit.
  std::optional<Pair> add(Side side, const Ptr& message) {
    std::deque<Ptr>& own = waitingOn(side);
    std::deque<Ptr>& others = waitingOn(side == Side::kLeft ? Side::kRight : Side::kLeft);
    const auto partner = std::find_if(others.begin(), others.end(), [&](const Ptr& other) { return fit(*message, *other); });
    own.push_back(message);
    if (partner == others.end()) {
      if (own.size() > kDepth) giveUp(side, 1);
      return {};
    }
    const Pair pair = side == Side::kLeft ? Pair{message, *partner} : Pair{*partner, message};
    const size_t before = static_cast<size_t>(partner - others.begin());
    giveUp(Side::kLeft, side == Side::kLeft ? left_.size() - 1 : before);
    giveUp(Side::kRight, side == Side::kRight ? right_.size() - 1 : before);
    left_.pop_front();
    right_.pop_front();
    return pair;
  }

  /// [s] How far the newest left message is from the nearest right one, once several of both sides wait in vain; nothing as
  /// long as pairs are found or one side is silent.
  std::optional<double> mismatch() const {
    if (left_.size() < kPatience || right_.size() < kPatience) return {};
    double nearest = difference(*left_.back(), *right_.front());
    for (const Ptr& right : right_) nearest = std::min(nearest, difference(*left_.back(), *right));
    return nearest;
  }

  /// No more messages will come.
  void giveUpAll() {
    giveUp(Side::kLeft, left_.size());
    giveUp(Side::kRight, right_.size());
  }

  /// Forgets everything in silence.
  void clear() {
    left_.clear();
    right_.clear();
  }

 private:
  static constexpr size_t kDepth = 30;    ///< messages that wait while the other side is silent (ours: 1 to 2 s of images)
  static constexpr size_t kPatience = 4;  ///< messages of each side; fewer may wait because one side is late (ours)

  static double difference(const Message& a, const Message& b) {
    return std::abs(secondsBetween(a.header.stamp, b.header.stamp));
  }
  bool fit(const Message& a, const Message& b) const { return difference(a, b) <= tolerance_; }

  std::deque<Ptr>& waitingOn(Side side) { return side == Side::kLeft ? left_ : right_; }

  void giveUp(Side side, size_t count) {
    for (std::deque<Ptr>& waiting = waitingOn(side); count > 0; --count) {
      const Ptr lonely = waiting.front();
      waiting.pop_front();
      if (give_up_) give_up_(side, lonely);
    }
  }

  double tolerance_;
  GiveUp give_up_;
  std::deque<Ptr> left_, right_;  ///< in the order of arrival
};

}  // namespace cabinet_articulation
