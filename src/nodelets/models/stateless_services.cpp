// SPDX-License-Identifier: BSD-3-Clause
#include "nodelets/models/stateless_services.h"

#include "nodelets/models/offer_service.h"
#include "ros/answers/model_answers.h"

namespace cabinet_articulation {

std::vector<ros::ServiceServer> offerStatelessServices(ros::NodeHandle* nh,
                                                       const std::function<core::ArticulationConfig()>& config,
                                                       const CallbackGuard& guard) {
  const auto evaluate = [config](const auto& request, auto* response) { *response = evaluateModel(request, config()); };
  const auto poses = [](const auto& request, auto* response) { *response = projectPoses(request); };
  const auto configurations = [](const auto& request, auto* response) { *response = projectConfigurations(request); };
  return {offerService<EvaluateModel>(nh, "evaluate_model", guard, evaluate),
          offerService<ProjectPoses>(nh, "project_poses", guard, poses),
          offerService<ProjectConfigurations>(nh, "project_configurations", guard, configurations)};
}

}  // namespace cabinet_articulation
