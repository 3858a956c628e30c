// SPDX-License-Identifier: BSD-3-Clause
#include <sensor_msgs/JointState.h>
#include <tf2_ros/transform_broadcaster.h>

#include <algorithm>
#include <deque>
#include <pluginlib/class_list_macros.hpp>
#include <set>
#include <utility>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/joints/hanging.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/structure/structure_finder.h"
#include "closing/closed_finder.h"
#include "nodelets/models/model_services.h"
#include "nodelets/models/model_store.h"
#include "nodelets/running/callback_threads.h"
#include "nodelets/stages/stage_nodelet.h"
#include "ros/answers/joints.h"
#include "ros/checks/clock_jump.h"

namespace cabinet_articulation {

/// Tracks -> models of how each front moves; tf and joint states of those that moved; services on what was learned.
class ArticulationStage : public StageNodelet {
 public:
  ArticulationStage() : StageNodelet("articulation") {}

 private:
  void start() override {
    core::LearningConfig config;
    ModelFileConfig file;
    loadSettings(config, file, output_);
    learner_ = std::make_unique<core::ArticulationLearner>(config.articulation);
    structure_ = std::make_unique<core::StructureFinder>(config.articulation, config.structure);
    getMTNodeHandle().setCallbackQueue(requests_.queue());
    store_ = std::make_unique<ModelStore>(getMTNodeHandle(), file, config, storeCalls(), guard());
    report([this] { return store_->loadAtStart(); });
    services_ = std::make_unique<ModelServices>(getMTNodeHandle(), config.articulation, file.models_file, store_.get(), guard());
    services_->countFromClosed(output_.countsFromClosed());
    requests_.start(kRequestThreads);
    offerTuning<core::LearningConfig>(config, [this](const auto& tuned) {
      std::lock_guard<std::mutex> lock(store_->learning());
      auto learner = std::make_unique<core::ArticulationLearner>(tuned.articulation);
      structure_ = std::make_unique<core::StructureFinder>(tuned.articulation, tuned.structure);
      told_.clear();
      learner_ = std::move(learner);
      remember(store_->ownJoints());
      store_->configureKinds(tuned);
      services_->setConfig(tuned.articulation);
    });
    require(&tracks_topic_);
    prefix_ = jointPrefix(getNodeHandle().getNamespace());
    models_ = advertise<ArticulationModelArray>("models");
    // A robot_state_publisher that is started late needs to know where the fronts were left.
    joint_states_ = advertise<sensor_msgs::JointState>("joint_states", [this](const auto& subscriber) {
      std::string frame_id;
      const std::vector<core::LearnedModel> known = store_->jointModels(&frame_id);
      const sensor_msgs::JointState left = lastJointStates(counted(known), frame_id);
      if (!left.name.empty()) subscriber.publish(left);
    });
  }

  StoreCalls storeCalls() {
    const auto start_from = [this](const std::vector<core::LearnedModel>& joints) {
      learner_->reset();
      closed_.reset();
      structure_->reset();
      told_.clear();
      remember(joints);
    };
    const auto forget = [this](std::uint32_t id) {
      learner_->forget(id);
      closed_.forget(id);
      structure_->forget(id);
    };
    return {start_from, forget, [this] { health().setLasting("models_file", ""); }};
  }

  void subscribe() override {
    tracks_topic_.subscribe<TrackArray>(getNodeHandle(), "tracks", guard(), [this](const auto& tracks) {
      {
        std::lock_guard<std::mutex> lock(waiting_mutex_);
        waiting_.push_back(tracks);
        if (waiting_.size() > kMostWaiting) {
          waiting_.pop_front();
          health().dropped();
        }
      }
      workOnAll([this] { process(); });
    });
  }

  void unsubscribe() override { tracks_topic_.shutdown(); }

  void finish() override {
    requests_.stop();
    if (services_) services_->shutdown();
    if (store_) report([this] { return store_->saveAtExit(); });
  }

  /// What happened to the model file. Without it the work goes on.
  void report(const std::function<std::string()>& work) {
    try {
      const std::string text = work();
      if (!text.empty()) NODELET_INFO("%s: %s", getName().c_str(), text.c_str());
    } catch (const std::exception& error) {
      health().setLasting("models_file", error.what());
      NODELET_ERROR("%s: %s", getName().c_str(), error.what());
    }
  }

  /// All tracks that wait, for each message only holds what is new; learned is once, from the newest state.
  void process() {
    std::deque<TrackArrayConstPtr> messages;
    {
      std::lock_guard<std::mutex> lock(waiting_mutex_);
      messages.swap(waiting_);
    }
    if (messages.empty()) return;
    for (std::size_t i = 1; i < messages.size(); ++i) health().dropped();
    runStage(messages.back()->header, [&] {
      std::lock_guard<std::mutex> lock(store_->learning());
      TrackArrayConstPtr newest;
      for (const TrackArrayConstPtr& tracks : messages)
        if (takeOver(*tracks)) newest = tracks;
      if (newest) learn(newest->header);
    });
  }

  /// False for tracks that are not to be used.
  bool takeOver(const TrackArray& tracks) {
    std::vector<core::TrackUpdate> updates;
    core::DepthView view;
    try {
      updates = tracks_topic_.decode(tracks);
      view = tracks_topic_.decode(tracks.view);
    } catch (const std::invalid_argument& error) {
      trouble("input", error.what());
      return false;
    }
    const GenerationWatch::Verdict verdict = store_->judge(tracks);
    if (!verdict.trouble.empty()) trouble("known_fronts", verdict.trouble);
    if (!verdict.use) return false;
    const std::string other_frame = store_->followFrame(tracks.header.frame_id);
    if (!other_frame.empty()) trouble("frame", other_frame);
    if (clock_jump_(tracks.header.stamp)) {
      NODELET_WARN("%s: time jumped back; joints stay known, all else is forgotten", getName().c_str());
      store_->startAfresh();
      last_transforms_ = ros::Time();
    }
    view.stamp = tracks.header.stamp.toSec();
    closed_.see(std::move(view));
    store_->dropForgotten(&updates);
    const std::size_t gaps = store_->follow(std::move(updates));
    if (gaps > 0)
      trouble("gap", tracks_topic_.topic() + ": messages were lost or are not from the beginning; " + std::to_string(gaps) +
                         (gaps == 1 ? " track stays" : " tracks stay") + " as known until sent as a whole, within some seconds");
    return true;
  }

  void learn(const std_msgs::Header& header) {
    std::vector<core::LearnedModel> models = learner_->process(store_->tracks());
    closed_.complete(&models);
    structure_->complete(store_->tracks(), &models);
    noteStructure(models);
    health().note("models", static_cast<double>(models.size()));
    health().note("joints", static_cast<double>(std::count_if(models.begin(), models.end(), core::isJoint)));
    store_->update(&models);
    const std::vector<core::LearnedModel> joints = counted(models);
    sensor_msgs::JointState joint_states = jointStates(joints, header, closed_.leftClosed());
    if (!joint_states.name.empty()) publish(joint_states_, std::move(joint_states));
    broadcast(joints, header);
    publish(models_, toMessage(models, header));
  }

  void remember(const std::vector<core::LearnedModel>& joints) {
    const std::vector<core::LearnedModel> of_the_world = core::thoseOfTheWorld(joints);
    learner_->remember(of_the_world);
    closed_.remember(of_the_world);
    structure_->remember(joints);
  }

  /// Says once what fronts have one degree of freedom.
  void noteStructure(const std::vector<core::LearnedModel>& models) {
    const auto hangs = [](const core::LearnedModel& model) { return model.parent != 0; };
    health().note("hanging", static_cast<double>(std::count_if(models.begin(), models.end(), hangs)));
    health().note("coupled", static_cast<double>(structure_->coupled().size()));
    for (const core::CoupledFronts& fronts : structure_->coupled())
      if (told_.size() < kMostTold && told_.insert(std::minmax(fronts.first, fronts.second)).second)
        NODELET_INFO("%s: fronts %u and %u have one degree of freedom: the second's q grows by %.2f with the first's",
                     getName().c_str(), fronts.first, fronts.second, fronts.ratio);
  }

  /// As joint states and frames count.
  std::vector<core::LearnedModel> counted(const std::vector<core::LearnedModel>& models) const {
    return output_.countsFromClosed() ? core::allCountedFromClosed(models) : models;
  }

  /// tf warns about repeated stamps, so each is sent once.
  void broadcast(const std::vector<core::LearnedModel>& models, const std_msgs::Header& header) {
    if (!output_.publish_tf || header.stamp <= last_transforms_) return;
    const std::vector<geometry_msgs::TransformStamped> transforms = jointTransforms(models, header, prefix_);
    if (transforms.empty()) return;
    broadcaster_.sendTransform(transforms);
    last_transforms_ = header.stamp;
  }

  static constexpr int kRequestThreads = 4;  ///< ours: a fit of a long track does not hold up a robot's predictions
  CallbackThreads requests_;                 ///< outlives the services
  std::unique_ptr<core::ArticulationLearner> learner_;
  core::ClosedFinder closed_;
  std::unique_ptr<core::StructureFinder> structure_;
  static constexpr std::size_t kMostTold = 1024;            ///< ours: a log of more is not read
  std::set<std::pair<std::uint32_t, std::uint32_t>> told_;  ///< coupled fronts that the log names already
  std::unique_ptr<ModelStore> store_;
  std::unique_ptr<ModelServices> services_;
  FrameOutputConfig output_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Time last_transforms_;
  std::string prefix_;
  ClockJump clock_jump_;
  static constexpr std::size_t kMostWaiting = 32;  ///< [frames] ours: 2 s at 15 Hz; what is older is lost
  std::mutex waiting_mutex_;                       ///< guards waiting_
  std::deque<TrackArrayConstPtr> waiting_;
  ros::Publisher models_, joint_states_;
  WatchedSubscriber tracks_topic_;
};

using ArticulationNodelet = EndsInOrder<ArticulationStage>;

}  // namespace cabinet_articulation

PLUGINLIB_EXPORT_CLASS(cabinet_articulation::ArticulationNodelet, nodelet::Nodelet)
