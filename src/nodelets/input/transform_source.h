// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/subscriber.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <Eigen/Geometry>
#include <mutex>
#include <string>

#include "nodelets/running/callback_threads.h"
#include "ros/checks/callback_guard.h"
#include "ros/checks/clock_jump.h"

namespace cabinet_articulation {

/*
 * tf as the stages need it. Forgets what it heard when stamps or the clock jump back (a looped bag): tf ignores everything that
 * is older than what it knows.
 *
 * Subscribes by itself, for tf2_ros::TransformListener lets a stamp near the end of time end the process.
 */
class TransformSource {
 public:
  /// Transforms that no robot has go to the guard.
  explicit TransformSource(const CallbackGuard& guard) : guard_(guard) {}

  /// Begins to hear tf. A stage that will need it says so early: connecting takes longer than a frame, and what was sent before
  /// is lost. Otherwise the first question that needs an answer begins.
  void listen();

  /// T_target_source at `stamp`. Waits up to `patience` seconds of wall time for it, so that a paused bag blocks nobody.
  /// Throws std::runtime_error naming both frames and what tf says.
  Eigen::Isometry3d lookup(const std::string& target, const std::string& source, const ros::Time& stamp, double patience);

 private:
  ros::Subscriber subscribe(ros::NodeHandle& nh, const std::string& topic, bool is_static);
  void add(const tf2_msgs::TFMessage& message, bool is_static);

  const CallbackGuard guard_;
  ClockJump clock_jump_;
  std::once_flag listening_;
  tf2::BufferCore buffer_;
  ros::Time last_heard_;
  CallbackThreads thread_;  ///< of its own: the stage's may wait for a frame that waits for transforms
  ros::Subscriber moving_, static_;
};

}  // namespace cabinet_articulation
