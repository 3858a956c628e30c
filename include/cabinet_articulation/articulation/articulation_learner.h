// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/articulation/articulation_model.h"
#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/// What is known about how one front moves. All fields as in ArticulationModel.msg, in the frame of the track.
struct LearnedModel {
  std::uint32_t id = 0;
  double stamp = 0;  ///< [s] of the newest observation
  JointType type = JointType::kRigid;
  std::vector<double> probabilities;  ///< index = JointType
  bool moved = false;                 ///< false: not enough motion to tell yet
  bool explained = true;              ///< false: moved, but no model describes it ("none of these")
  Eigen::Isometry3d origin = Eigen::Isometry3d::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d axis_point = Eigen::Vector3d::Zero();
  double radius = 0;
  double q = 0, q_min = 0, q_max = 0;
  double width = 0, height = 0;
  Matrix6d covariance = Matrix6d::Zero();  ///< as ArticulationModel.covariance
  double position_error = 0, orientation_error = 0;
  int observations = 0;
  std::vector<ModelParam> params;

  /// Eq. (8): the front's centre pose at q.
  Eigen::Isometry3d predict(double q) const;
};

/// Paper III-D: candidate models for every track, the best one selected (Eq. 11).
class ArticulationLearner {
 public:
  explicit ArticulationLearner(const ArticulationConfig& config);
  ~ArticulationLearner();

  /// The models of all tracks given; models of tracks that are no longer given are forgotten. Ordered by id. A track
  /// without any usable observation has no model; observations that are not finite are ignored.
  std::vector<LearnedModel> process(const std::vector<Track>& tracks);

  void reset();

 private:
  struct State;
  ArticulationConfig config_;
  std::unique_ptr<State> state_;
};

/// All candidate models of one track, the best first; empty if no observation is usable.
std::vector<LearnedModel> fitAllModels(const Track& track, const ArticulationConfig& config);

}  // namespace cabinet_articulation::core
