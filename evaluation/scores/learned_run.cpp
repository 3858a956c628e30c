// SPDX-License-Identifier: BSD-3-Clause
#include "scores/learned_run.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "articulation/models/model_registry.h"
#include "cabinet_articulation/joints/hanging.h"

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr double kMinOpened = 0.03;
constexpr double kSameFront = 0.05;  ///< [m]

/// Axis of the motion between two poses of a front.
void setAxis(const Eigen::Isometry3d& closed, const Eigen::Isometry3d& open, TrueJoint* joint) {
  const Eigen::Isometry3d motion = open * closed.inverse();
  if (joint->type != JointType::kRotational) {
    joint->axis = (open.translation() - closed.translation()).normalized();
    return;
  }
  joint->axis = Eigen::AngleAxisd(motion.linear()).axis();
  // A fixed point of the motion; the one nearest to the origin, as I - R is singular along the axis.
  const Eigen::Matrix3d turn = Eigen::Matrix3d::Identity() - motion.linear();
  joint->axis_point = turn.completeOrthogonalDecomposition().solve(motion.translation());
}

bool moves(const LearnedModel& model) { return model.moved && modelEntry(model.type).moves; }

}  // namespace

std::vector<TrueJoint> findJoints(const std::vector<Frame>& frames) {
  std::vector<TrueJoint> joints;
  for (std::size_t i = 0; i < frames.at(0).fronts.size(); ++i) {
    TrueJoint joint;
    joint.name = frames[0].fronts[i].name;
    joint.type = frames[0].fronts[i].type;
    for (const Frame& frame : frames) {
      ReferencePose pose{frame.fronts.at(i).rectangle, frame.fronts[i].opened};
      pose.rectangle.pose = frame.T_world_camera * pose.rectangle.pose;
      joint.poses.push_back(pose);
    }
    const auto less = [](const ReferencePose& a, const ReferencePose& b) { return a.opened < b.opened; };
    const auto [closed, open] = std::minmax_element(joint.poses.begin(), joint.poses.end(), less);
    if (open->opened - closed->opened < kMinOpened) continue;
    setAxis(closed->rectangle.pose, open->rectangle.pose, &joint);
    joints.push_back(joint);
  }
  return joints;
}

JointType trueType(const LearnedModel& model, const std::vector<LearnedModel>& all, const std::vector<Frame>& frames) {
  const auto isNearer = [&](const Frame& a, const Frame& b) {
    return std::abs(a.stamp - model.stamp) < std::abs(b.stamp - model.stamp);
  };
  const Frame& seen = *std::min_element(frames.begin(), frames.end(), isNearer);
  const Eigen::Vector3d center = seen.T_world_camera.inverse() * (frameOf(model, all) * model.predict(model.q)).translation();
  const Front* front = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Front& other : seen.fronts) {
    const double distance = (other.rectangle.center() - center).norm();
    if (distance >= std::min(least, std::max(other.rectangle.width, other.rectangle.height) / 2)) continue;
    least = distance;
    front = &other;
  }
  for (const TrueJoint& joint : findJoints(frames))
    if (front && joint.name == front->name) return joint.type;
  return JointType::kRigid;
}

void LearnedRun::add(const std::vector<LearnedModel>& models) {
  last_ = models;
  types_.emplace_back();
  for (const LearnedModel& model : models)
    if (moves(model) && model.explained) types_.back()[model.id] = model.type;
}

std::optional<LearnedJoint> LearnedRun::find(const TrueJoint& joint) const {
  std::optional<LearnedJoint> best;
  for (const LearnedModel& model : allPlaced(last_)) {
    if (!model.moved) continue;
    const PredictionError error = predictionError(model, joint.poses);
    if (error.position > (best ? best->prediction.position : kSameFront)) continue;
    best.emplace();
    best->model = model;
    best->prediction = error;
  }
  if (!best) return best;
  for (std::size_t i = types_.size(); i-- > 0;) {
    const auto known = types_[i].find(best->model.id);
    if (known == types_[i].end() || known->second != joint.type) break;
    best->right_from = joint.poses[i].opened;
  }
  best->axis_angle = std::acos(std::min(1.0, std::abs(joint.axis.dot(best->model.axis))));
  best->axis_distance = (best->model.axis_point - joint.axis_point).cross(joint.axis).norm();
  return best;
}

int LearnedRun::movers() const { return static_cast<int>(std::count_if(last_.begin(), last_.end(), moves)); }

}  // namespace cabinet_articulation::core::evaluation
