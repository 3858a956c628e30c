// SPDX-License-Identifier: BSD-3-Clause
#include <sensor_msgs/JointState.h>
#include <tf2_ros/transform_broadcaster.h>

#include <pluginlib/class_list_macros.hpp>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/joints.h"
#include "clock_jump.h"
#include "latest_worker.h"
#include "model_services.h"
#include "stage_nodelet.h"

namespace cabinet_articulation {

/// Tracks -> models of how each front moves; tf and joint states of those that moved; services on what was learned.
class ArticulationNodelet : public StageNodelet {
 public:
  ArticulationNodelet() : StageNodelet("articulation") {}
  ~ArticulationNodelet() override {
    if (services_) services_->shutdown();
    stop();
  }

 private:
  void start() override {
    core::ArticulationConfig config;
    loadSettings(config);
    learner_ = std::make_unique<core::ArticulationLearner>(config);
    services_ = std::make_unique<ModelServices>(getMTNodeHandle(), config, [this] { learner_->reset(); });
    worker_ = std::make_unique<LatestWorker<TrackArrayConstPtr>>([this](const auto& tracks) { process(*tracks); });
    require(&tracks_topic_);
    prefix_ = jointPrefix(getNodeHandle().getNamespace());
    models_ = advertise<ArticulationModelArray>("models");
    joint_states_ = advertise<sensor_msgs::JointState>("joint_states");
  }

  void subscribe() override {
    tracks_topic_.subscribe<TrackArray>(getNodeHandle(), "tracks", [this](const auto& tracks) {
      if (worker_->put(tracks)) health().dropped();
    });
  }

  void unsubscribe() override { tracks_topic_.shutdown(); }

  void process(const TrackArray& tracks) {
    const std_msgs::Header& header = tracks.header;
    std::lock_guard<std::mutex> lock(services_->learning());
    if (services_->isOutdated(tracks)) return;
    runStage(header, [&] {
      if (clock_jump_(header.stamp)) {
        NODELET_WARN("%s: time jumped back; all models are forgotten", getName().c_str());
        learner_->reset();
        services_->clear();
        last_transforms_ = ros::Time();
      }
      std::vector<core::Track> fronts = fromMessage(tracks);
      const std::vector<core::LearnedModel> models = learner_->process(fronts);
      services_->update(header, std::move(fronts), models);
      sensor_msgs::JointState joint_states = jointStates(models, header, prefix_);
      if (!joint_states.name.empty()) publish(joint_states_, std::move(joint_states));
      broadcast(models, header);
      publish(models_, toMessage(models, header));
    });
  }

  /// tf warns about repeated stamps, so each is sent once.
  void broadcast(const std::vector<core::LearnedModel>& models, const std_msgs::Header& header) {
    if (header.stamp <= last_transforms_) return;
    const std::vector<geometry_msgs::TransformStamped> transforms = jointTransforms(models, header, prefix_);
    if (transforms.empty()) return;
    broadcaster_.sendTransform(transforms);
    last_transforms_ = header.stamp;
  }

  std::unique_ptr<core::ArticulationLearner> learner_;
  std::unique_ptr<ModelServices> services_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Time last_transforms_;
  std::string prefix_;
  ClockJump clock_jump_;
  ros::Publisher models_, joint_states_;
  std::unique_ptr<LatestWorker<TrackArrayConstPtr>> worker_;
  WatchedSubscriber tracks_topic_;
};

}  // namespace cabinet_articulation

PLUGINLIB_EXPORT_CLASS(cabinet_articulation::ArticulationNodelet, nodelet::Nodelet)
