// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/KnownFrontArray.h>
#include <cabinet_articulation/TrackArray.h>
#include <ros/ros.h>

#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "cabinet_articulation/joints/known_fronts.h"
#include "cabinet_articulation/joints/model_file.h"
#include "joints/cleared_kinds.h"
#include "joints/removed_fronts.h"
#include "kinds/kind_memory.h"
#include "nodelets/models/generation_watch.h"
#include "nodelets/running/settings.h"
#include "ros/checks/callback_guard.h"

namespace cabinet_articulation {

/// What others are told. The first two are for the learner, and called with ModelStore::learning() held.
struct StoreCalls {
  std::function<void(const std::vector<core::LearnedModel>& joints)> start_from;  ///< forget everything else
  std::function<void(std::uint32_t id)> forget;
  std::function<void()> file_was_good;  ///< a file was loaded or saved, so that an earlier error is none any more
};

/*
 * Everything that was learned, in memory and in files. May be used at any time from any thread.
 *
 * What is loaded, reset and forgotten reaches the tracker, which may run elsewhere, by the topic `known_fronts`. Tracks that it
 * published before it heard of that are recognised by their generation. Forgotten fronts are recognised by their ids, which are
 * never given to others.
 */
class ModelStore {
 public:
  /// `nh`: where the topic lives. What goes wrong while somebody is told of known fronts goes to the guard.
  ModelStore(ros::NodeHandle nh, const ModelFileConfig& file, const core::LearningConfig& config, StoreCalls calls,
             const CallbackGuard& guard);
  ~ModelStore() { known_fronts_.shutdown(); }

  // Each says how it went; they throw core::ModelFileError, and have changed nothing then.
  std::string loadAtStart();
  std::string load(const std::string& file);
  std::string save(const std::string& file);
  /// If save_at_exit is set.
  std::string saveAtExit();

  /// Forgets one front, here, at the tracker and in models_file. Throws core::ModelError for an id nobody knows.
  std::string forget(std::uint32_t id);
  void reset();

  /// Names a front, and says what it is called now. Throws core::ModelError for an id nobody knows, core::NameError for a name
  /// that cannot be given.
  std::string setName(std::uint32_t id, const std::string& name);

  /// To be held while tracks are learned from, from judge() to update(): so a reset comes between two frames.
  std::mutex& learning() { return learning_; }

  /// The kinds of what was learned, in files too. With learning() held.
  const core::KindMemory& kinds() const { return kinds_; }

  /// New settings of kinds. With learning() held.
  void configureKinds(const core::LearningConfig& config) {
    std::lock_guard<std::mutex> lock(mutex_);
    kinds_.configure(config);
  }

  /// Forgets all kinds, and those of each file when it is saved next.
  void clearKinds();

  /// Whether these tracks are to be learned from. With learning() held.
  GenerationWatch::Verdict judge(const TrackArray& tracks);

  /// The frame of the tracks that come now. Forgets what was known in another frame, and says so; else empty.
  std::string followFrame(const std::string& frame_id);

  /// Tracks that were published before the tracker forgot them.
  void dropForgotten(std::vector<core::TrackUpdate>* tracks) const;

  /// Puts the tracks of one frame together. Returns how many wait for being sent as a whole. With learning() held, as the two
  /// that follow.
  std::size_t follow(std::vector<core::TrackUpdate> updates);

  const std::vector<core::Track>& tracks() const { return known_.tracks(); }

  /// Keeps the models of these tracks. Then each is given the name of its front, and what kinds tell of it, for whoever asks.
  void update(std::vector<core::LearnedModel>* models);

  /// Time was set back: joints stay known, as if they had been saved and loaded again; all else is forgotten. To be called
  /// with learning() held.
  void startAfresh();

  /// The model of a front, with what kinds tell of it, and the frame it is in. Throws core::ModelError for an id nobody knows.
  core::LearnedModel modelOf(std::uint32_t id, std::string* frame_id) const;

  /// Of all joints that are known, in view or not, given up or not.
  std::vector<core::LearnedModel> jointModels(std::string* frame_id = nullptr) const;

  /// The same as their own poses say, for learners.
  std::vector<core::LearnedModel> ownJoints() const {
    std::lock_guard<std::mutex> lock(mutex_);
    return known_.jointModels();
  }

 private:
  std::string nameOfFrame(const std::string& frame_id) const;

  void forgetKinds();
  void restart(const core::ModelFile& models);
  KnownFrontArray listOf(const core::ModelFile& models) const;
  void greet(const ros::SingleSubscriberPublisher& subscriber) const;

  ros::NodeHandle nh_;
  const ModelFileConfig file_;
  const StoreCalls calls_;

  // Waited for in this order.
  std::mutex filing_;  ///< held while a file is written, and while something is removed from what is known
  std::mutex learning_;
  mutable std::mutex mutex_;  ///< guards what follows
  core::KindMemory kinds_;    ///< changed with learning_ held, too
  core::ClearedKinds cleared_kinds_;
  core::KnownFronts known_;
  core::RemovedFronts removed_;
  std::set<std::uint32_t> forgotten_;  ///< ids
  std::string frame_id_;               ///< of the models
  std::uint32_t generation_ = 0;
  std::uint32_t next_id_ = 0;  ///< lower ones are used up; 0: none was seen
  GenerationWatch watch_;
  ros::Publisher known_fronts_;
};

}  // namespace cabinet_articulation
