// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "cabinet_articulation/rectangles/detected_rectangle.h"

namespace cabinet_articulation::core {

/// Values as in ArticulationModel.msg.
enum class JointType : std::uint8_t { kRigid = 0, kPrismatic = 1, kRotational = 2 };

/// A pose track as the learner sees it: poses of one reference point of the front.
struct PoseTrack {
  std::vector<double> stamps;  ///< [s] ascending
  std::vector<Eigen::Isometry3d> poses;
  bool has_orientation = true;  ///< false: positions only (logs of three columns)
};

/// A named number of a model, for ArticulationModel.params; names as in the original release.
struct ModelParam {
  enum Kind : std::uint8_t { kPrior = 0, kParam = 1, kEval = 2 };
  std::string name;
  double value = 0;
  Kind kind = kParam;
};

}  // namespace cabinet_articulation::core
