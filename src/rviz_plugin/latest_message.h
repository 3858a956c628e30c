// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include <functional>
#include <string>

namespace cabinet_articulation {

constexpr double kSilence = 5;  ///< [s] ours: longer than a pipeline is silent while it catches up

/// A topic and how long ago it spoke. Messages are handled one by one, and not kept.
template <class Message>
class LatestMessage {
 public:
  using Handler = std::function<void(const Message&)>;

  void subscribe(ros::NodeHandle nh, const std::string& topic, const Handler& handle) {
    shutdown();
    topic_ = topic.empty() ? "" : nh.resolveName(topic);
    if (topic.empty()) return;
    const boost::function<void(const boost::shared_ptr<const Message>&)> came = [this, handle](const auto& message) {
      ++count_;
      arrived_ = ros::Time::now();
      handle(*message);
    };
    subscriber_ = nh.subscribe<Message>(topic, kQueue, came);
  }

  void shutdown() {
    subscriber_.shutdown();
    count_ = 0;
  }

  /// False where no topic was chosen.
  bool isWanted() const { return !topic_.empty(); }

  std::size_t count() const { return count_; }

  /// Nothing for `timeout` [s], or nobody publishes any more. False before the first message.
  bool isStale(double timeout) const {
    if (count_ == 0) return false;
    if (subscriber_.getNumPublishers() == 0) return true;
    return timeout > 0 && (ros::Time::now() - arrived_).toSec() > timeout;
  }

  /// "no message on /cabinet/models yet", and what to look at.
  std::string whatIsMissing() const {
    if (subscriber_.getNumPublishers() == 0) return "nobody publishes " + topic_ + ": is the pipeline running in that namespace?";
    if (count_ == 0) return "no message on " + topic_ + " yet: do images arrive? /diagnostics says what the pipeline waits for";
    return "no message on " + topic_ + " any more";
  }

 private:
  static constexpr int kQueue = 20;  ///< ours: 1 s of frames, for a track's messages build on one another

  ros::Subscriber subscriber_;
  std::string topic_;
  std::size_t count_ = 0;
  ros::Time arrived_;
};

}  // namespace cabinet_articulation
