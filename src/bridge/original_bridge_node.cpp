// SPDX-License-Identifier: BSD-3-Clause
// Speaks to programs of the original release: its services, answered by this package's learner, and what the pipeline tracks and
// learns in its messages.
#include <articulation_msgs/ArticulatedObjectSrv.h>
#include <articulation_msgs/GetModelPriorSrv.h>
#include <articulation_msgs/SetModelPriorSrv.h>
#include <articulation_msgs/TrackModelSrv.h>
#include <ros/ros.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bridge/foreign_tracks.h"
#include "bridge/live_models.h"
#include "bridge/original_learner.h"
#include "bridge/spanning_tree.h"

namespace cabinet_articulation::bridge {
namespace {

using articulation_msgs::ArticulatedObjectSrv;
using articulation_msgs::GetModelPriorSrv;
using articulation_msgs::ModelMsg;
using articulation_msgs::SetModelPriorSrv;
using articulation_msgs::TrackModelSrv;

/// As the original's learners take them; orientations count by default, unlike there.
core::ArticulationConfig loadConfig() {
  core::ArticulationConfig config;
  const ros::NodeHandle parameters("~");
  config.joint_types = parameters.param<std::string>("filter_models", "rigid prismatic rotational");
  config.sigma_position = parameters.param("sigma_position", config.sigma_position);
  config.sigma_orientation = parameters.param("sigma_orientation", config.sigma_orientation);
  core::checkConfig(config);
  return config;
}

class OriginalBridge {
 public:
  explicit OriginalBridge(const core::ArticulationConfig& config) : config_(config), learner_(config) {
    const bool learns = ros::NodeHandle("~").param("learn", false);
    if (learns)
      foreign_ = std::make_unique<ForeignTracks>(nh_, config);
    else
      live_ = std::make_unique<LiveModels>(nh_);
    answerModels("model_select", &OriginalLearner::select);
    answerModels("model_fit", &OriginalLearner::fit);
    answerModels("model_eval", &OriginalLearner::eval);
    answerModels("model_resample", &OriginalLearner::resampled);
    answerModels("model_project_pose_to_configuration", &OriginalLearner::posesToConfigurations);
    answerModels("model_project_configuration_to_pose", &OriginalLearner::configurationsToPoses);
    answerModels("model_store", &OriginalLearner::store);
    answer<GetModelPriorSrv>("model_prior_get", [this](const auto&, auto* response) { response->model = learner_.prior(); });
    answer<SetModelPriorSrv>("model_prior_set", [this](const auto& request, auto*) { learner_.setPrior(request.model); });
    answer<ArticulatedObjectSrv>("get_spanning_tree", [this](const auto& request, auto* response) {
      response->object = spanningTree(request.object, config_);
    });
  }

 private:
  /// The original's services have no field for a reason: the call fails, and the log says why.
  template <class Service, class Answer>
  void answer(const std::string& name, const Answer& work) {
    using Request = typename Service::Request;
    using Response = typename Service::Response;
    const boost::function<bool(Request&, Response&)> callback = [name, work](Request& request, Response& response) {
      try {
        work(request, &response);
        return true;
      } catch (const std::exception& error) {
        ROS_ERROR("%s: %s", name.c_str(), error.what());
        return false;
      }
    };
    servers_.push_back(nh_.advertiseService<Request, Response>(name, callback));
  }

  template <class Method>
  void answerModels(const std::string& name, Method method) {
    answer<TrackModelSrv>(
        name, [this, method](const auto& request, auto* response) { response->model = (learner_.*method)(request.model); });
  }

  ros::NodeHandle nh_;
  core::ArticulationConfig config_;
  OriginalLearner learner_;
  std::unique_ptr<LiveModels> live_;
  std::unique_ptr<ForeignTracks> foreign_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace
}  // namespace cabinet_articulation::bridge

int main(int argc, char** argv) {
  ros::init(argc, argv, "original_bridge");
  try {
    ros::NodeHandle keep_alive;
    const cabinet_articulation::bridge::OriginalBridge bridge(cabinet_articulation::bridge::loadConfig());
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL("original_bridge: %s", error.what());
    return 1;
  }
  return 0;
}
