// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <optional>

#include "recent_messages.h"
#include "settings.h"

namespace cabinet_articulation {

enum class Side { kLeft, kRight };

/// Finds the partner of each message of a stereo pair by its stamp, and knows by how much the two sides miss each other.
template <class Message>
class PairMatcher {
 public:
  using Ptr = boost::shared_ptr<const Message>;

  struct Pair {
    Ptr left, right;
  };

  explicit PairMatcher(double tolerance) : tolerance_(tolerance) {}

  /// The pair that this message completes.
  std::optional<Pair> add(Side side, const Ptr& message) {
    RecentMessages<Message>& own = side == Side::kLeft ? left_ : right_;
    const RecentMessages<Message>& others = side == Side::kLeft ? right_ : left_;
    own.add(message);
    const Ptr partner = others.find(message->header.stamp, tolerance_);
    if (!partner) {
      ++(side == Side::kLeft ? lonely_left_ : lonely_right_);
      return {};
    }
    lonely_left_ = lonely_right_ = 0;
    return side == Side::kLeft ? Pair{message, partner} : Pair{partner, message};
  }

  /// [s] How far the newest left message is from the nearest right one, once both sides went without a partner for
  /// several messages; nothing as long as pairs are found or one side is silent.
  std::optional<double> mismatch() const {
    if (lonely_left_ < kPatience || lonely_right_ < kPatience) return {};
    const ros::Time stamp = left_.newest()->header.stamp;
    return std::abs(secondsBetween(stamp, right_.nearest(stamp)->header.stamp));
  }

  void clear() {
    left_.clear();
    right_.clear();
    lonely_left_ = lonely_right_ = 0;
  }

 private:
  static constexpr size_t kDepth = 8;
  static constexpr int kPatience = 4;

  double tolerance_;
  RecentMessages<Message> left_{kDepth}, right_{kDepth};
  int lonely_left_ = 0, lonely_right_ = 0;
};

}  // namespace cabinet_articulation
