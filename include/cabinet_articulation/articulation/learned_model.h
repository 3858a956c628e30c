// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "cabinet_articulation/geometry/joint_type.h"
#include "cabinet_articulation/rectangles/detected_rectangle.h"

namespace cabinet_articulation::core {

/// A named number of a model, for ArticulationModel.params; names as in the original release.
struct ModelParam {
  enum Kind : std::uint8_t { kPrior = 0, kParam = 1, kEval = 2 };
  std::string name;
  double value = 0;
  Kind kind = kParam;
};

/// What is known about how one front moves. All fields as in ArticulationModel.msg, in the frame of the track.
struct LearnedModel {
  std::uint32_t id = 0;
  double stamp = 0;  ///< [s] of the newest observation
  std::string name;  ///< given by people
  JointType type = JointType::kRigid;
  std::vector<double> probabilities;  ///< index = JointType; that of kNonparametric counts motions that no model describes
  bool moved = false;                 ///< false: not enough motion to tell yet
  bool explained = true;              ///< false: moved, but no model describes it ("none of these")
  bool observed = true;               ///< false: expected to be a joint of a known kind, but never seen to move
  bool hollow = false;                ///< seen to be a frame around a hole
  double support = 0;                 ///< observations at different places on the joint's path; 0: it is not established yet
  double doubt = 0;                   ///< how near observations off the path are to outweighing those; 1: it was given up
  std::uint32_t parent = 0;           ///< id of the front it hangs on; 0: the world
  double parent_probability = 1;
  Eigen::Isometry3d origin = Eigen::Isometry3d::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d axis_point = Eigen::Vector3d::Zero();
  double pitch = 0;  ///< [m/rad]
  double radius = 0;
  double q = 0, q_min = 0, q_max = 0;
  bool q_min_is_end = false, q_max_is_end = false;             ///< false: merely reached
  double q_closed = std::numeric_limits<double>::quiet_NaN();  ///< NaN: unknown, as `opening`
  bool closed_known = false;
  double opening = std::numeric_limits<double>::quiet_NaN();  ///< 0 closed, 1 widest seen or end
  std::vector<Eigen::Isometry3d> curve;  ///< nonparametric: the front's centre at equal steps of q from q_min to q_max
  double width = 0, height = 0;
  Matrix6d covariance = Matrix6d::Zero();  ///< as ArticulationModel.covariance
  double position_error = 0, orientation_error = 0;
  int observations = 0;
  std::vector<ModelParam> params;

  /// Eq. (8): the front's centre pose at q.
  Eigen::Isometry3d predict(double q) const;

  /// The q at which the front is nearest to this pose of its centre.
  double configuration(const Eigen::Isometry3d& front) const;
};

}  // namespace cabinet_articulation::core
