// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <boost/shared_ptr.hpp>
#include <deque>

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

  /// The message of exactly this stamp, the newest of equals; null if there is none.
  Ptr find(const ros::Time& stamp) const {
    for (auto it = messages_.rbegin(); it != messages_.rend(); ++it)
      if ((*it)->header.stamp == stamp) return *it;
    return {};
  }

  /// The last to arrive; null if there is none.
  Ptr newest() const { return messages_.empty() ? Ptr() : messages_.back(); }

  void clear() { messages_.clear(); }

 private:
  size_t capacity_;
  std::deque<Ptr> messages_;
};

}  // namespace cabinet_articulation
