// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <articulation_msgs/ModelMsg.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "bridge/original_params.h"
#include "cabinet_articulation/articulation/articulation_config.h"

namespace cabinet_articulation::bridge {

/// [poses] of all fits for one answer, which come one after another. With the default types these take 2 s in fits to 80 poses
/// each, and 1 s in longer ones. Measured on 1000 and 100 stored doors, and on 190 pairs of parts.
constexpr std::size_t kMostFittedPoses = 200000;

/// [bytes] of all stored models, as messages (ours: some 3000 doors of 100 poses each).
constexpr std::size_t kMostStoredBytes = 64U << 20U;

/// Throws std::invalid_argument for more poses than that; `what` takes the fits.
void requireSoon(const std::string& what, std::size_t poses);

/// What the original release's model learners answer, by this package's learner. All of it throws std::invalid_argument or
/// std::runtime_error, in words for whoever asked. The stored models are the only state.
class OriginalLearner {
 public:
  using Model = articulation_msgs::ModelMsg;

  /// `config.joint_types` are the candidates of select().
  explicit OriginalLearner(const core::ArticulationConfig& config) : config_(config) {}

  /// The most probable model of the track, or a stored one that takes the track in: what has the least sum of BIC over all
  /// models. A stored one keeps its id, and comes with both tracks; the id of a new one is -1. Throws for
  /// more stored poses than kMostFittedPoses, with the request's poses counted for each model.
  Model select(const Model& request) const;

  /// The model that the request names, fitted to its track.
  Model fit(const Model& request) const;

  /// The model as its parameters say, evaluated on its track.
  Model eval(const Model& request) const;

  /// Channel q0 for the poses, and the poses of channel q0.
  Model posesToConfigurations(const Model& request) const;
  Model configurationsToPoses(const Model& request) const;

  Model resampled(const Model& request) const;

  /// Keeps the model; one with the id -1 gets the first that is free. Throws for more than limits::kMostFronts models, and for
  /// more than kMostStoredBytes.
  Model store(const Model& request);

  std::vector<Model> prior() const;

  /// In place of all that is stored, or nothing changes.
  void setPrior(const std::vector<Model>& models);

 private:
  std::map<int, Model> stored_;
  std::size_t bytes_ = 0;  ///< of all of them
  core::ArticulationConfig config_;
};

/// The most probable model of a track that was fitted as `config` says, described and evaluated in `message`, which has the
/// track.
void fitTo(const core::ArticulationConfig& config, articulation_msgs::ModelMsg* message);

/// `config` with what the parameters of a request change: sigma_position, sigma_orientation, and disable_all with enable_<model>.
/// Throws ConfigError for what is out of range.
core::ArticulationConfig configured(core::ArticulationConfig config, const Params& params);

}  // namespace cabinet_articulation::bridge
