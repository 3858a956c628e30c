// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <articulation_msgs/ModelMsg.h>
#include <cabinet_articulation/ArticulationModelArray.h>
#include <cabinet_articulation/TrackArray.h>
#include <ros/ros.h>

#include <string>
#include <vector>

#include "cabinet_articulation/tracking/track_updates.h"

namespace cabinet_articulation::bridge {

/// The models whose tracks are known, in the frame of the message, with parents at their present q. A front that is no joint, or
/// merely expected to be one, is rigid at its present place. `left_out` names one that cannot be used, and why.
std::vector<articulation_msgs::ModelMsg> originalModels(const ArticulationModelArray& models,
                                                        const std::vector<core::Track>& tracks, std::string* left_out);

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
