// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <articulation_msgs/ModelMsg.h>

#include <string>
#include <vector>

#include "bridge/original_track.h"
#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/articulation/learned_model.h"

namespace cabinet_articulation::bridge {

/// The name of a type in model messages: rigid, prismatic and rotational as in the original release, and screw and nonparametric,
/// which it does not have.
std::string originalName(core::JointType type);

/// Those of all types.
std::vector<std::string> originalNames();

/// Throws std::invalid_argument for another name; pca_gp is one, whose Gaussian processes only the original can evaluate.
core::JointType typeOf(const std::string& name);

/// Writes name and parameters, as they describe the pose in the track's messages rather than the front's centre.
void describe(const core::LearnedModel& model, const Eigen::Isometry3d& T_pose_center, articulation_msgs::ModelMsg* message);

/// The other way: the joint that name and parameters describe, of the front's centre. Throws std::invalid_argument that names
/// what is missing or beyond limits.h.
core::LearnedModel restore(const articulation_msgs::ModelMsg& message, const OriginalTrack& track);

/// What evaluating the model on the message's track finds. Channel q0, pose_projected, pose_flags, and the EVAL parameters;
/// `loglikelihood` and `bic` are ours (see doc/bridge.md).
void evaluate(const core::LearnedModel& model, const OriginalTrack& track, const core::ArticulationConfig& config,
              articulation_msgs::ModelMsg* message);

/// Writes pose_resampled: poses from q_min to q_max every `resample_density` (a parameter) or else 0.05 rad or 0.01 m, as the
/// original release. At most limits::kMostEntries poses.
void resample(const core::LearnedModel& model, const Eigen::Isometry3d& T_pose_center, articulation_msgs::ModelMsg* message);

}  // namespace cabinet_articulation::bridge
