// SPDX-License-Identifier: BSD-3-Clause
#include "tools/truth/joint_watch.h"

#include <algorithm>

#include "cabinet_articulation/joints/joint.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "tools/truth/truth_comparison.h"

namespace cabinet_articulation {

int JointWatch::typeInSight(const core::Rectangle& front, const std::vector<core::LearnedModel>& models) {
  int found = -1;
  for (const core::LearnedModel& model : models) {
    if (!core::isJoint(model)) continue;
    const int type = static_cast<int>(model.type);
    const bool is_here = distanceToModel(model, front) < kFoundWithin;
    // A model of the wrong type may be far off where the front is open: its id tells that it is this front's.
    if (!is_here && (type == true_type_ || !ids_.count(model.id))) continue;
    if (found != true_type_) found = type;
    if (type == true_type_) ids_.insert(model.id);
  }
  return found;
}

void JointWatch::add(double stamp, const JointTruth& truth, const std::vector<core::LearnedModel>& models,
                     const IsRemembered& is_remembered) {
  type_ = typeInSight({fromMessage(truth.pose), truth.width, truth.height}, models);
  const bool has_live_model =
      std::any_of(models.begin(), models.end(), [this](const auto& model) { return ids_.count(model.id); });
  if (type_ < 0 && !has_live_model && std::any_of(ids_.begin(), ids_.end(), is_remembered)) {
    type_ = true_type_;
    ++remembered_;
  }
  count(stamp);
}

void JointWatch::addLost(double stamp) {
  type_ = -1;
  count(stamp);
}

void JointWatch::count(double stamp) {
  const bool known = type_ == true_type_;
  if (!everKnown()) {
    if (!known) return;
    first_known_ = last_known_ = stamp;
  }
  ++frames_;
  if (known) {
    ++known_;
    last_known_ = stamp;
  } else if (type_ >= 0) {
    ++as_other_;
    other_type_ = type_;
  }
  if (stamp - last_known_ <= longest_gap_) return;
  longest_gap_ = stamp - last_known_;
  longest_gap_start_ = last_known_;
}

const char* JointWatch::otherType() const { return typeName(other_type_); }

const char* JointWatch::now() const { return type_ < 0 ? "-" : typeName(type_); }

}  // namespace cabinet_articulation
