// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/ArticulationModelArray.h>
#include <cabinet_articulation/TrackArray.h>
#include <ros/ros.h>

#include "cabinet_articulation/tracking/track_updates.h"

namespace cabinet_articulation::bridge {

/// What the pipeline publishes on `tracks` and `models`, on `track` and `model` in the original release's messages, one message
/// for each front.
class LiveModels {
 public:
  explicit LiveModels(ros::NodeHandle nh);

 private:
  void takeTracks(const TrackArray& message);
  void takeModels(const ArticulationModelArray& message);

  core::TrackAssembly fronts_;
  ros::Publisher track_, model_;
  ros::Subscriber tracks_, models_;
};

}  // namespace cabinet_articulation::bridge
