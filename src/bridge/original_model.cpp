// SPDX-License-Identifier: BSD-3-Clause
#include "bridge/original_model.h"

#include <cabinet_articulation/ArticulationModel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "bridge/original_params.h"
#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/joints/evaluation.h"
#include "cabinet_articulation/ros/pose_conversions.h"

namespace cabinet_articulation::bridge {
namespace {

using articulation_msgs::ModelMsg;
using articulation_msgs::ParamMsg;
using articulation_msgs::TrackMsg;
using core::JointType;

/// The core has no name for it.
constexpr auto kScrew = static_cast<JointType>(ArticulationModel::SCREW);

struct Kind {
  JointType type;
  const char* name;
  int complexity;  ///< parameters as the original release counts them, without those of each pose of a curve
  int degrees;     ///< of freedom
  double density;  ///< [m or rad] between resampled poses, original release
};

constexpr std::array<Kind, 5> kKinds{{{JointType::kRigid, "rigid", 6, 0, 0.01},
                                      {JointType::kPrismatic, "prismatic", 8, 1, 0.01},
                                      {JointType::kRotational, "rotational", 9, 1, 0.05},
                                      {JointType::kNonparametric, "nonparametric", 2, 1, 0.01},
                                      {kScrew, "screw", 10, 1, 0.05}}};

const Kind& kindOf(JointType type) {
  return *std::find_if(kKinds.begin(), kKinds.end(), [type](const Kind& kind) { return kind.type == type; });
}

double complexityOf(const core::LearnedModel& model) {
  constexpr double kOfPose = 6;
  return kindOf(model.type).complexity + kOfPose * static_cast<double>(model.curve.size());
}

bool turns(JointType type) { return type == JointType::kRotational || type == kScrew; }

/// T(center, axis) Rz(-q) Tx(radius) R(orientation) is the original's forward map, so its z points against our axis.
void describeTurn(const core::LearnedModel& model, const Eigen::Isometry3d& pose, Params* params) {
  const Eigen::Vector3d along = model.axis * model.axis.dot(pose.translation() - model.axis_point);
  const Eigen::Vector3d center = model.axis_point + along, arm = pose.translation() - center;
  const double radius = arm.norm();
  Eigen::Matrix3d frame;
  constexpr double kZero = 1e-9;  // [m] a pose on the axis has no direction from it
  frame.col(0) = radius > kZero ? Eigen::Vector3d(arm / radius) : model.axis.unitOrthogonal();
  frame.col(2) = -model.axis;
  frame.col(1) = frame.col(2).cross(frame.col(0));
  setParam("rot_center", center, ParamMsg::PARAM, params);
  setParam("rot_axis", Eigen::Quaterniond(frame), ParamMsg::PARAM, params);
  setParam("rot_radius", radius, ParamMsg::PARAM, params);
  setParam("rot_orientation", Eigen::Quaterniond(frame.transpose() * pose.linear()), ParamMsg::PARAM, params);
  setParam("rot_mode", 0, ParamMsg::PARAM, params);
}

void restoreTurn(const Params& params, const Eigen::Isometry3d& T_pose_center, core::LearnedModel* model) {
  const Eigen::Quaterniond frame = requireQuaternion(params, "rot_axis");
  const double radius = requireParam(params, "rot_radius");
  core::requireWithin("rot_radius", radius, core::limits::kRadius);
  const Eigen::Isometry3d T_frame = Eigen::Translation3d(requireVector(params, "rot_center")) * frame;
  model->axis = -(frame * Eigen::Vector3d::UnitZ());
  model->origin = T_frame * Eigen::Translation3d(radius, 0, 0) * requireQuaternion(params, "rot_orientation") * T_pose_center;
  const Eigen::Vector3d away = model->origin.translation() - T_frame.translation();
  model->axis_point = T_frame.translation() + model->axis * model->axis.dot(away);
  model->radius = (model->origin.translation() - model->axis_point).norm();
}

std::string ofCurve(std::size_t i) { return "curve[" + std::to_string(i) + "]"; }

void restoreCurve(const Params& params, const Eigen::Isometry3d& T_pose_center, core::LearnedModel* model) {
  const double count = requireParam(params, "curve.size");
  core::requireWithin("curve.size", count, {0, static_cast<double>(core::kMostCurvePoses), "poses"});
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
    model->curve.push_back(Eigen::Translation3d(requireVector(params, ofCurve(i) + ".position")) *
                           requireQuaternion(params, ofCurve(i) + ".orientation") * T_pose_center);
}

void describeCurve(const core::LearnedModel& model, const Eigen::Isometry3d& T_center_pose, Params* params) {
  setParam("curve.size", static_cast<double>(model.curve.size()), ParamMsg::PARAM, params);
  for (std::size_t i = 0; i < model.curve.size(); ++i) {
    const Eigen::Isometry3d pose = model.curve[i] * T_center_pose;
    setParam(ofCurve(i) + ".position", Eigen::Vector3d(pose.translation()), ParamMsg::PARAM, params);
    setParam(ofCurve(i) + ".orientation", Eigen::Quaterniond(pose.linear()), ParamMsg::PARAM, params);
  }
}

}  // namespace

std::string originalName(JointType type) { return kindOf(type).name; }

std::vector<std::string> originalNames() {
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) names.emplace_back(kind.name);
  return names;
}

JointType typeOf(const std::string& name) {
  std::string known;
  for (const Kind& kind : kKinds) {
    if (name == kind.name) return kind.type;
    known += std::string(known.empty() ? "" : ", ") + kind.name;
  }
  throw std::invalid_argument("the model is called '" + name + "', expected one of " + known);
}

void describe(const core::LearnedModel& model, const Eigen::Isometry3d& T_pose_center, ModelMsg* message) {
  const Eigen::Isometry3d T_center_pose = T_pose_center.inverse(), pose = model.origin * T_center_pose;
  const Kind& kind = kindOf(model.type);
  Params& params = message->params;
  message->name = kind.name;
  if (turns(model.type)) {
    describeTurn(model, pose, &params);
  } else {
    setParam("rigid_position", Eigen::Vector3d(pose.translation()), ParamMsg::PARAM, &params);
    setParam("rigid_orientation", Eigen::Quaterniond(pose.linear()), ParamMsg::PARAM, &params);
  }
  if (model.type == JointType::kPrismatic || model.type == JointType::kNonparametric)
    setParam("prismatic_dir", model.axis, ParamMsg::PARAM, &params);
  if (model.type == kScrew) setParam("screw_pitch", model.pitch, ParamMsg::PARAM, &params);
  if (model.type == JointType::kNonparametric) describeCurve(model, T_center_pose, &params);
  if (kind.degrees > 0) {
    setParam("q_min[0]", model.q_min, ParamMsg::PARAM, &params);
    setParam("q_max[0]", model.q_max, ParamMsg::PARAM, &params);
  }
  setParam("complexity", complexityOf(model), ParamMsg::PRIOR, &params);
  setParam("dofs", kind.degrees, ParamMsg::EVAL, &params);
}

core::LearnedModel restore(const ModelMsg& message, const OriginalTrack& track) {
  core::LearnedModel model;
  const Params& params = message.params;
  core::requireAtMost("params", params.size(), core::limits::kMostEntries);
  model.type = typeOf(message.name);
  model.width = track.track.width;
  model.height = track.track.height;
  model.q_min = paramOr(params, "q_min[0]", 0);
  model.q_max = paramOr(params, "q_max[0]", 0);
  core::requireWithin("q_min[0]", model.q_min, core::limits::kConfiguration);
  core::requireWithin("q_max[0]", model.q_max, core::limits::kConfiguration);
  // A screw tells one turn from the next by it.
  model.position_error = paramOr(params, "avg_error_position", 0);
  core::requireWithin("avg_error_position", model.position_error, core::limits::kError);
  if (turns(model.type)) {
    restoreTurn(params, track.T_pose_center, &model);
  } else {
    model.origin = Eigen::Translation3d(requireVector(params, "rigid_position")) *
                   requireQuaternion(params, "rigid_orientation") * track.T_pose_center;
  }
  if (model.type == JointType::kPrismatic) model.axis = requireVector(params, "prismatic_dir").normalized();
  if (model.type == kScrew) model.pitch = requireParam(params, "screw_pitch");
  core::requireWithin("screw_pitch", model.pitch, core::limits::kConfiguration);
  if (model.type == JointType::kNonparametric) restoreCurve(params, track.T_pose_center, &model);
  core::requireShape(model);
  return model;
}

void evaluate(const core::LearnedModel& model, const OriginalTrack& track, const core::ArticulationConfig& config,
              ModelMsg* message) {
  const core::TrackEvaluation evaluation = core::evaluateOnTrack(model, track.track, config);
  const Eigen::Isometry3d T_center_pose = track.T_pose_center.inverse();
  TrackMsg& out = message->track;
  const std::size_t n = out.pose.size();
  out.pose_projected.clear();
  for (const Eigen::Isometry3d& projected : evaluation.projected)
    out.pose_projected.push_back(toMessage(projected * T_center_pose));
  if (kindOf(model.type).degrees > 0) {
    std::vector<float>& q = channel("q0", &out);
    for (std::size_t i = 0; i < n; ++i) q[i] = static_cast<float>(evaluation.nearest[i].q);
  }
  out.pose_flags.resize(n, TrackMsg::POSE_VISIBLE);
  out.pose_flags.back() |= TrackMsg::POSE_END_OF_SEGMENT;
  message->header = out.header;
  Params& params = message->params;
  const auto samples = static_cast<double>(n);
  setParam("sigma_position", config.sigma_position, ParamMsg::PRIOR, &params);
  setParam("sigma_orientation", config.sigma_orientation, ParamMsg::PRIOR, &params);
  setParam("samples", samples, ParamMsg::EVAL, &params);
  setParam("avg_error_position", evaluation.position_error, ParamMsg::EVAL, &params);
  setParam("avg_error_orientation", evaluation.orientation_error, ParamMsg::EVAL, &params);
  setParam("outlier_ratio", evaluation.outlier_ratio, ParamMsg::EVAL, &params);
  setParam("cost_of_freedom", evaluation.cost_of_freedom, ParamMsg::EVAL, &params);
  setParam("loglikelihood", evaluation.log_likelihood, ParamMsg::EVAL, &params);
  const double penalty = complexityOf(model) * std::log(samples);
  setParam("bic", -2 * evaluation.log_likelihood + penalty, ParamMsg::EVAL, &params);
  setParam("evaluated", 1, ParamMsg::EVAL, &params);
}

void resample(const core::LearnedModel& model, const Eigen::Isometry3d& T_pose_center, ModelMsg* message) {
  const double density = paramOr(message->params, "resample_density", kindOf(model.type).density);
  const double range = std::max(0.0, model.q_max - model.q_min);
  if (!(density > 0) || range / density > static_cast<double>(core::limits::kMostEntries - 1))
    throw std::invalid_argument("resample_density is " + std::to_string(density) + ", expected more than 0, for at most " +
                                std::to_string(core::limits::kMostEntries) + " poses");
  const int steps = kindOf(model.type).degrees > 0 ? static_cast<int>(std::floor(range / density + 1e-9)) : 0;
  message->track.pose_resampled.clear();
  for (int i = 0; i <= steps; ++i)
    message->track.pose_resampled.push_back(toMessage(model.predict(model.q_min + i * density) * T_pose_center.inverse()));
}

}  // namespace cabinet_articulation::bridge
