// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/Configuration.h>
#include <cabinet_articulation/ExportUrdf.h>
#include <cabinet_articulation/FitTrack.h>
#include <cabinet_articulation/Forget.h>
#include <cabinet_articulation/HandlePath.h>
#include <cabinet_articulation/Kinds.h>
#include <cabinet_articulation/LoadModels.h>
#include <cabinet_articulation/Predict.h>
#include <cabinet_articulation/SaveModels.h>
#include <cabinet_articulation/SetName.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <atomic>
#include <mutex>
#include <string>
#include <vector>

#include "cabinet_articulation/articulation/articulation_config.h"
#include "nodelets/models/model_store.h"

namespace cabinet_articulation {

/// The services on what was learned. They may be called at any time from any thread; each answer says in words why there is
/// none.
class ModelServices {
 public:
  /// `nh`: where the services live. `store` lives longer than they. A refused request is told to whoever asked; whatever else
  /// goes wrong goes to the guard too.
  ModelServices(ros::NodeHandle nh, const core::ArticulationConfig& config, const std::string& models_file, ModelStore* store,
                const CallbackGuard& guard);

  /// Ends the services, and waits for calls that are running.
  void shutdown();

  /// For export_urdf: joints count from where they are closed, and others are left out.
  void countFromClosed(bool from_closed) { from_closed_ = from_closed; }

  /// For fit_track and the stateless services.
  void setConfig(const core::ArticulationConfig& config);

 private:
  template <class Service>
  void advertise(const std::string& name,
                 void (ModelServices::*answer)(const typename Service::Request&, typename Service::Response*));

  core::ArticulationConfig settingsNow();
  core::LearnedModel modelOf(std::uint32_t id, std_msgs::Header* header) const;
  void predict(const Predict::Request& request, Predict::Response* response);
  void configuration(const Configuration::Request& request, Configuration::Response* response);
  void fitTrack(const FitTrack::Request& request, FitTrack::Response* response);
  void handlePath(const HandlePath::Request& request, HandlePath::Response* response);
  void saveModels(const SaveModels::Request& request, SaveModels::Response* response);
  void loadModels(const LoadModels::Request& request, LoadModels::Response* response);
  void exportUrdf(const ExportUrdf::Request& request, ExportUrdf::Response* response);
  void kinds(const Kinds::Request& request, Kinds::Response* response);
  void forget(const Forget::Request& request, Forget::Response* response);
  void setName(const SetName::Request& request, SetName::Response* response);
  void reset(const std_srvs::Trigger::Request& request, std_srvs::Trigger::Response* response);
  std::string fileOr(const std::string& requested) const;

  ros::NodeHandle nh_;
  const std::string models_file_;
  ModelStore& store_;
  const CallbackGuard guard_;
  std::atomic<bool> from_closed_{false};
  std::mutex mutex_;  ///< guards the settings
  core::ArticulationConfig config_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace cabinet_articulation
