// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "cabinet_articulation/articulation/learned_model.h"
#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/// Where a front was that others may hang on. Its joint smooths its poses, so that their noise does not move what hangs on it.
class CarrierPath {
 public:
  /// `joint` is that of the front in the world. Observations farther apart than `pause` [s] say where it was in between only if
  /// it was at the same place before and after.
  CarrierPath(const Track& track, LearnedModel joint, double pause);

  const LearnedModel& joint() const { return joint_; }

  /// Its q at a time; nothing if that was not seen.
  std::optional<double> configurationAt(double stamp) const;

  std::optional<Eigen::Isometry3d> at(double stamp) const;

 private:
  LearnedModel joint_;
  double pause_;
  std::vector<double> stamps_, q_;
};

/// [m] How far any corner of the front is moved from q to another q.
double wayOfCorners(const LearnedModel& joint, double q, double other);

}  // namespace cabinet_articulation::core
