// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include <functional>
#include <vector>

#include "cabinet_articulation/articulation/articulation_config.h"
#include "ros/checks/callback_guard.h"

namespace cabinet_articulation {

/// The services about models that are sent in: evaluate_model, project_poses, project_configurations. `config` gives the settings
/// of the moment, and may be called from any thread.
std::vector<ros::ServiceServer> offerStatelessServices(ros::NodeHandle* nh,
                                                       const std::function<core::ArticulationConfig()>& config,
                                                       const CallbackGuard& guard);

}  // namespace cabinet_articulation
