// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <optional>

#include "cabinet_articulation/ros/pose_conversions.h"

namespace cabinet_articulation {

enum class FrameOrder { kNewer, kNotNewer, kSetBack };

/// Recognises by the stamps of the frames that time was set back (a looped bag, a restarted simulation). Frames that are
/// merely out of order are no jump.
class ClockJump {
 public:
  bool operator()(const ros::Time& stamp) {
    const bool jumped = newest_ && secondsBetween(stamp, *newest_) > kOutOfOrder;
    if (jumped || !newest_ || stamp > *newest_) newest_ = stamp;
    return jumped;
  }

  /// Where a frame belongs among those before. What is not newer is out of order or was there already.
  FrameOrder orderOf(const ros::Time& stamp) {
    const std::optional<ros::Time> before = newest_;
    if ((*this)(stamp)) return FrameOrder::kSetBack;
    return !before || stamp > *before ? FrameOrder::kNewer : FrameOrder::kNotNewer;
  }

  /// The newest stamp since time was set back last; nothing before the first.
  const std::optional<ros::Time>& newest() const { return newest_; }

 private:
  static constexpr double kOutOfOrder = 1;  ///< [s]

  std::optional<ros::Time> newest_;
};

}  // namespace cabinet_articulation
