// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <image_transport/image_transport.h>
#include <ros/ros.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>

#include "cabinet_articulation/ros/pose_conversions.h"
#include "ros/checks/callback_guard.h"

namespace cabinet_articulation {

/// Throws std::runtime_error that names the transports of image_transport that are installed, unless this is one of them.
void requireInstalled(const ros::NodeHandle& nh, const std::string& transport);

/// A subscription that knows since when it has been silent. The callback gets the publisher's own message, and what it throws
/// goes to the guard. So does a message whose stamp is beyond all use.
class WatchedSubscriber {
 public:
  template <class Message>
  using Callback = std::function<void(const boost::shared_ptr<const Message>&)>;

  WatchedSubscriber() = default;
  ~WatchedSubscriber();

  template <class Message>
  void subscribe(ros::NodeHandle& nh, const std::string& topic, const CallbackGuard& guard, const Callback<Message>& callback) {
    const std::string resolved = nh.resolveName(topic);
    // Most messages are small: without this, TCP holds them back for some 40 ms where stages run in several processes.
    const auto hints = ros::TransportHints().tcpNoDelay();
    set({nh.subscribe<Message>(topic, kQueue, heard<Message>(resolved, guard, callback), ros::VoidConstPtr(), hints), {}});
  }

  /// An image by a transport of image_transport that is installed: raw, compressed or compressedDepth. A plugin has its own
  /// parameters below `parameters`; raw needs none.
  void subscribeImage(ros::NodeHandle& nh, const ros::NodeHandle& parameters, const std::string& topic,
                      const std::string& transport, const CallbackGuard& guard, const Callback<sensor_msgs::Image>& callback);

  /// Waits for a callback that is running.
  void shutdown() {
    Subscription subscription = this->subscription();
    subscription.messages.shutdown();
    subscription.images.shutdown();
  }

  /// Resolved; empty before the first subscription. The first one must not be under way in another thread.
  const std::string& topic() const { return topic_; }

  /// Core types of a message that came here; an error names the topic.
  template <class Message>
  auto decode(const Message& message) const {
    try {
      return fromMessage(message);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(topic_ + ": " + error.what());
    }
  }

  /// May be called at any time from any thread, also while the stage subscribes anew.
  std::uint32_t publishers() const;

  /// In words, what is missing after `patience` seconds without a message; empty if all is well.
  std::string silence(double patience) const;

 private:
  // The callbacks only store the message, so this queue never grows; it bridges a scheduling delay.
  static constexpr std::uint32_t kQueue = 8;

  /// One of the two.
  struct Subscription {
    ros::Subscriber messages;
    image_transport::Subscriber images;
  };

  /// The callback of a subscription that begins now.
  template <class Message>
  Callback<Message> heard(const std::string& resolved, const CallbackGuard& guard, const Callback<Message>& callback) {
    // Named once: the worker reads the name while the stage subscribes anew.
    std::call_once(named_, [&] { topic_ = resolved; });
    heard_ = ros::WallTime::now().toSec();
    return [this, guard, resolved, callback](const boost::shared_ptr<const Message>& message) {
      heard_ = ros::WallTime::now().toSec();
      guard(resolved, [&] {
        requireStamp("header.stamp", message->header.stamp);
        callback(message);
      });
    };
  }

  /// The one before ends when the lock is free again: `subscription` outlives it.
  void set(Subscription subscription) {
    std::lock_guard<std::mutex> lock(mutex_);
    std::swap(subscription_, subscription);
  }

  /// The same subscription. ROS is asked without the lock, for it may wait for a callback that wants it too.
  Subscription subscription() const {
    std::lock_guard<std::mutex> lock(mutex_);
    return subscription_;
  }

  std::unique_ptr<image_transport::ImageTransport> transports_;  ///< of compressed images; has the plugins of `images`
  mutable std::mutex mutex_;                                     ///< guards the next
  Subscription subscription_;
  std::once_flag named_;
  std::string topic_;
  std::atomic<double> heard_{0};
};

}  // namespace cabinet_articulation
