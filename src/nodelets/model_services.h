// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/Configuration.h>
#include <cabinet_articulation/FitTrack.h>
#include <cabinet_articulation/HandlePath.h>
#include <cabinet_articulation/Predict.h>
#include <cabinet_articulation/TrackArray.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "cabinet_articulation/joints/known_fronts.h"

namespace cabinet_articulation {

/*
 * The services on what was learned. They may be called at any time from any thread; each answer says in words why there
 * is none.
 *
 * Reset reaches the tracker, which may run elsewhere, by the topic `known_fronts`. Tracks that it published before it
 * heard of that are recognised by their generation.
 */
class ModelServices {
 public:
  /// `nh`: where the services live. `on_reset` forgets what was learned; learning() is held meanwhile.
  ModelServices(ros::NodeHandle nh, const core::ArticulationConfig& config, std::function<void()> on_reset);

  /// Waits for calls that are running.
  void shutdown();

  /// To be held while tracks are learned from, from isOutdated() to update(): so a reset comes between two frames.
  std::mutex& learning() { return learning_; }

  /// True for tracks of a tracker that does not know of the last reset yet.
  bool isOutdated(const TrackArray& tracks) const;

  /// What one frame gave.
  void update(const std_msgs::Header& header, std::vector<core::Track> tracks, const std::vector<core::LearnedModel>& models);

  /// Forgets everything.
  void clear();

 private:
  template <class Service>
  void advertise(const std::string& name,
                 void (ModelServices::*answer)(const typename Service::Request&, typename Service::Response*));

  core::LearnedModel modelOf(std::uint32_t id, std_msgs::Header* header) const;
  void predict(const Predict::Request& request, Predict::Response* response);
  void configuration(const Configuration::Request& request, Configuration::Response* response);
  void fitTrack(const FitTrack::Request& request, FitTrack::Response* response);
  void handlePath(const HandlePath::Request& request, HandlePath::Response* response);
  void reset(const std_srvs::Trigger::Request& request, std_srvs::Trigger::Response* response);
  void startGeneration();

  ros::NodeHandle nh_;
  const core::ArticulationConfig config_;
  const std::function<void()> on_reset_;

  std::mutex learning_;
  mutable std::mutex mutex_;  ///< guards the three below; never held while learning_ is waited for
  core::KnownFronts known_;
  std::string frame_id_;
  std::uint32_t generation_ = 0;

  ros::Publisher known_fronts_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace cabinet_articulation
