// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/Configuration.h>
#include <cabinet_articulation/ExportUrdf.h>
#include <cabinet_articulation/FitTrack.h>
#include <cabinet_articulation/HandlePath.h>
#include <cabinet_articulation/LoadModels.h>
#include <cabinet_articulation/Predict.h>
#include <cabinet_articulation/SaveModels.h>
#include <cabinet_articulation/TrackArray.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <std_srvs/Trigger.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "cabinet_articulation/joints/known_fronts.h"
#include "cabinet_articulation/joints/model_file.h"
#include "settings.h"

namespace cabinet_articulation {

/*
 * The services on what was learned. They may be called at any time from any thread; each answer says in words why there
 * is none.
 *
 * Resetting and loading reach the tracker, which may run elsewhere, by the topic `known_fronts`. Tracks that it published
 * before it heard of that are recognised by their generation.
 */
class ModelServices {
 public:
  /// `nh`: where the services live. `on_reset` forgets what was learned; learning() is held meanwhile.
  ModelServices(ros::NodeHandle nh, const core::ArticulationConfig& config, const ModelFileConfig& file,
                std::function<void()> on_reset);

  /// Loads models_file if there is one. Says how it went; throws ModelFileError.
  std::string loadAtStart();

  /// True once a file was loaded or saved, so that an earlier error is none any more.
  bool fileWasGood() const { return file_was_good_; }

  /// Ends the services (waiting for calls that are running), and saves if asked to. Says how it went; throws ModelFileError.
  std::string finish();

  /// To be held while tracks are learned from, from isOutdated() to update(): so a reset comes between two frames.
  std::mutex& learning() { return learning_; }

  /// True for tracks of a tracker that does not know of the last reset yet.
  bool isOutdated(const TrackArray& tracks) const;

  /// The frame of the tracks that come now. Forgets what was known in another frame, and says so; else empty.
  std::string followFrame(const std::string& frame_id);

  /// What one frame gave.
  void update(std::vector<core::Track> tracks, const std::vector<core::LearnedModel>& models);

  /// Where all joints that are known were left, in view or not.
  sensor_msgs::JointState lastJointStates(const std::string& prefix) const;

  /// For fit_track.
  void setConfig(const core::ArticulationConfig& config);

  /// Time was set back: joints stay known, as if they had been saved and loaded again; all else is forgotten. To be called
  /// with learning() held.
  void startAfresh();

 private:
  template <class Service>
  void advertise(const std::string& name,
                 void (ModelServices::*answer)(const typename Service::Request&, typename Service::Response*));

  core::LearnedModel modelOf(std::uint32_t id, std_msgs::Header* header) const;
  void predict(const Predict::Request& request, Predict::Response* response);
  void configuration(const Configuration::Request& request, Configuration::Response* response);
  void fitTrack(const FitTrack::Request& request, FitTrack::Response* response);
  void handlePath(const HandlePath::Request& request, HandlePath::Response* response);
  void saveModels(const SaveModels::Request& request, SaveModels::Response* response);
  void loadModels(const LoadModels::Request& request, LoadModels::Response* response);
  void exportUrdf(const ExportUrdf::Request& request, ExportUrdf::Response* response);
  void reset(const std_srvs::Trigger::Request& request, std_srvs::Trigger::Response* response);
  std::string fileOr(const std::string& requested) const;
  std::string save(const std::string& path);
  std::string load(const std::string& path);
  void startFrom(const core::ModelFile& models);
  void restart(const core::ModelFile& models);

  ros::NodeHandle nh_;
  const ModelFileConfig file_;
  const std::function<void()> on_reset_;

  std::mutex learning_;
  mutable std::mutex mutex_;  ///< guards the four below; never held while learning_ is waited for
  core::ArticulationConfig config_;
  core::KnownFronts known_;
  std::string frame_id_;  ///< of the models
  std::uint32_t generation_ = 0;
  std::atomic<bool> file_was_good_{false};

  ros::Publisher known_fronts_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace cabinet_articulation
