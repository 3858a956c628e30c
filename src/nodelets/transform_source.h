// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <Eigen/Geometry>
#include <memory>
#include <mutex>
#include <string>

#include "cabinet_articulation/ros/clock_jump.h"

namespace cabinet_articulation {

/// tf as the stages need it. Forgets what it heard when stamps jump back (a looped bag): tf ignores everything that is older
/// than what it knows.
class TransformSource {
 public:
  /// Begins to hear tf. A stage that will need it says so early: connecting takes longer than a frame, and what was sent before
  /// is lost. Otherwise the first question that needs an answer begins.
  void listen();

  /// T_target_source at `stamp`. Waits up to `patience` seconds of wall time for it, so that a paused bag blocks nobody.
  /// Throws std::runtime_error naming both frames and what tf says.
  Eigen::Isometry3d lookup(const std::string& target, const std::string& source, const ros::Time& stamp, double patience);

 private:
  ClockJump clock_jump_;
  std::once_flag listening_;
  std::unique_ptr<tf2_ros::Buffer> buffer_;
  std::unique_ptr<tf2_ros::TransformListener> listener_;
};

}  // namespace cabinet_articulation
