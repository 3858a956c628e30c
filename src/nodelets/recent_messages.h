// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <boost/shared_ptr.hpp>
#include <cmath>
#include <deque>

#include "cabinet_articulation/ros/pose_conversions.h"

namespace cabinet_articulation {

/// The last few messages of a topic, found by stamp. Unlike message_filters::Cache it keeps the order of arrival, so that
/// a clock that jumps back (a looped bag) leaves nothing behind that would hide the new messages.
template <class Message>
class RecentMessages {
 public:
  using Ptr = boost::shared_ptr<const Message>;

  explicit RecentMessages(size_t capacity) : capacity_(capacity) {}

  void add(const Ptr& message) {
    messages_.push_back(message);
    if (messages_.size() > capacity_) messages_.pop_front();
  }

  /// The message nearest to `stamp`, the newest of equals; null if none is within `tolerance` seconds.
  Ptr find(const ros::Time& stamp, double tolerance = 0) const {
    const Ptr found = nearest(stamp);
    return found && difference(found, stamp) <= tolerance ? found : Ptr();
  }

  Ptr nearest(const ros::Time& stamp) const {
    Ptr best;
    for (auto it = messages_.rbegin(); it != messages_.rend(); ++it)
      if (!best || difference(*it, stamp) < difference(best, stamp)) best = *it;
    return best;
  }

  Ptr newest() const { return messages_.empty() ? Ptr() : messages_.back(); }
  bool empty() const { return messages_.empty(); }
  void clear() { messages_.clear(); }

 private:
  static double difference(const Ptr& message, const ros::Time& stamp) {
    return std::abs(secondsBetween(stamp, message->header.stamp));
  }

  size_t capacity_;
  std::deque<Ptr> messages_;
};

}  // namespace cabinet_articulation
