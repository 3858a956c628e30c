// SPDX-License-Identifier: BSD-3-Clause
#include "structure/hanging_front.h"

#include <limits>
#include <utility>

#include "cabinet_articulation/joints/hanging.h"
#include "cabinet_articulation/joints/joint.h"
#include "structure/carrier_path.h"
#include "structure/seen_motion.h"
#include "structure/track_pair.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kSameJoint = 0.003;  ///< [m] sigma_plane: less is within the noise of what is placed by it

/// Whether both place the front alike wherever it was seen.
bool isSameJoint(const LearnedModel& a, const LearnedModel& b) {
  for (const double q : {b.q_min, (b.q_min + b.q_max) / 2, b.q_max}) {
    const Rectangle front = frontAt(b, q), same = frontAt(a, a.configuration(front.pose));
    if (distanceOfCorners(front, same) > kSameJoint) return false;
  }
  return true;
}

}  // namespace

void HangingFront::follow(const Track& track, const Track& carrier, const LearnedModel& carrier_joint) {
  if (!isJoint(carrier_joint)) return;
  if (!carrier_joint_ || !isSameJoint(*carrier_joint_, carrier_joint)) {
    carrier_joint_ = carrier_joint;
    ++revisions_;
  }
  seen_ = relativeTo(CarrierPath(carrier, *carrier_joint_, pause_), track).relative;
  seen_.revision = track.revision + revisions_;
}

LearnedModel HangingFront::describe(std::optional<double> ratio) const {
  LearnedModel model = joint_;
  model.parent = parent_;
  model.parent_probability = probability_;
  model.closed_known = false;
  model.q_closed = model.opening = std::numeric_limits<double>::quiet_NaN();
  removeCoupledRatio(&model);
  if (ratio) model.params.push_back({kCoupledRatio, *ratio, ModelParam::kEval});
  return model;
}

}  // namespace cabinet_articulation::core
