// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include <atomic>
#include <functional>
#include <string>

namespace cabinet_articulation {

/// A subscription that knows since when it has been silent. The callback gets the publisher's own message.
class WatchedSubscriber {
 public:
  template <class Message>
  void subscribe(ros::NodeHandle& nh, const std::string& topic,
                 const std::function<void(const boost::shared_ptr<const Message>&)>& callback) {
    heard_ = ros::WallTime::now().toSec();
    const auto heard = [this, callback](const boost::shared_ptr<const Message>& message) {
      heard_ = ros::WallTime::now().toSec();
      callback(message);
    };
    // Most messages are small: without this, TCP holds them back for some 40 ms where stages run in several processes.
    subscriber_ = nh.subscribe<Message>(topic, kQueue, heard, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
    topic_ = subscriber_.getTopic();
  }

  /// Waits for a callback that is running.
  void shutdown() { subscriber_.shutdown(); }

  /// Resolved; empty before the first subscription.
  const std::string& topic() const { return topic_; }

  std::uint32_t publishers() const { return subscriber_.getNumPublishers(); }

  /// In words, what is missing after `patience` seconds without a message; empty if all is well.
  std::string silence(double patience) const;

 private:
  // The callbacks only store the message, so this queue never grows; it bridges a scheduling delay.
  static constexpr std::uint32_t kQueue = 8;

  ros::Subscriber subscriber_;
  std::string topic_;
  std::atomic<double> heard_{0};
};

}  // namespace cabinet_articulation
