// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/joint_drawing.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "articulation/models/model_registry.h"
#include "cabinet_articulation/joints/hanging.h"
#include "cabinet_articulation/joints/joint.h"

namespace cabinet_articulation {
namespace {

constexpr int kRings = 9;
constexpr double kConfidence = 2.4477;  ///< sqrt of the 95 % quantile of chi square with two degrees of freedom
constexpr Color kInk{1, 1, 1};          ///< legible before all colours of fronts
constexpr float kGhostAlpha = 0.5F;
constexpr float kAxisAlpha = 0.3F;

std::string inLines(const std::string& label) {
  std::string text;
  for (const std::string& line : labelLines(label)) text += (text.empty() ? "" : "\n") + line;
  return text;
}

bool hasAxis(const core::LearnedModel& model) {
  return isJoint(model) && (core::modelEntry(model.type).turns || model.type == core::JointType::kPrismatic);
}

/// A square root of a covariance. It does not swap its columns from one ring to the next, as eigenvectors would.
Eigen::Matrix2d squareRoot(const Eigen::Matrix2d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance);
  const Eigen::Vector2d deviations = solver.eigenvalues().cwiseMax(0).cwiseSqrt();
  return solver.eigenvectors() * deviations.asDiagonal() * solver.eigenvectors().transpose();
}

std::vector<core::Rectangle> ghostsOf(const core::LearnedModel& model, const std::vector<core::Track>& tracks,
                                      const JointStyle& style) {
  if (style.ghosts <= 0) return {};
  if (!style.at_observations && style.ghosts == 1) return {frontAt(model, model.q_max)};
  if (!style.at_observations) return sweepOf(model, style.ghosts - 1);
  // Where the parent was when the front was seen is not known here.
  if (model.parent != 0) return {};
  const core::Track* track = core::findTrack(model.id, tracks);
  std::vector<core::Rectangle> ghosts;
  if (track == nullptr) return ghosts;
  const std::size_t seen = track->observations.size(), most = static_cast<std::size_t>(style.ghosts);
  const std::size_t step = (seen + most - 1) / most;
  for (std::size_t i = 0; i < seen; i += step)
    ghosts.push_back(frontAt(model, model.configuration(track->observations[i].rectangle.pose)));
  return ghosts;
}

/// Those that the style does not leave out.
std::vector<core::LearnedModel> shownOf(std::vector<core::LearnedModel> models, const JointStyle& style) {
  if (!style.resting)
    models.erase(std::remove_if(models.begin(), models.end(), [](const auto& model) { return !isJoint(model); }), models.end());
  if (!style.one_of_each_type) return models;
  const auto rank = [](const core::LearnedModel& model) {
    return std::make_tuple(model.type, -model.stamp, -core::typeProbability(model));
  };
  const auto comes_first = [&](const core::LearnedModel& a, const core::LearnedModel& b) { return rank(a) < rank(b); };
  std::stable_sort(models.begin(), models.end(), comes_first);
  const auto same_type = [](const core::LearnedModel& a, const core::LearnedModel& b) { return a.type == b.type; };
  models.erase(std::unique(models.begin(), models.end(), same_type), models.end());
  return models;
}

void drawJoint(const core::LearnedModel& model, const std::vector<core::Track>& tracks, const JointStyle& style,
               const Color& color, Drawing* drawing) {
  for (const core::Rectangle& ghost : ghostsOf(model, tracks, style)) addOutline(ghost, {color, kGhostAlpha}, drawing);
  if (style.ghosts > 0) addPath(wayOf(model, model.q_min, model.q_max), {color}, drawing);
  if (!style.axis) return;
  const auto axis = axisOf(model);
  drawing->lines.push_back({axis.first, axis.second, {kAxisColor}});
  addTube(axisUncertainty(model), {kAxisColor, kAxisAlpha}, drawing);
}

}  // namespace

std::vector<TubeRing> axisUncertainty(const core::LearnedModel& model) {
  if (!hasAxis(model) || !model.covariance.allFinite() || model.covariance.isZero(0)) return {};
  const auto ends = axisOf(model);
  // The position that the covariance speaks of, and a base of the plane across the axis.
  const Eigen::Vector3d at = core::modelEntry(model.type).turns ? model.axis_point : model.origin.translation();
  Eigen::Matrix<double, 3, 2> across;
  across.col(0) = model.axis.unitOrthogonal();
  across.col(1) = model.axis.cross(across.col(0));
  std::vector<TubeRing> rings;
  for (int i = 0; i < kRings; ++i) {
    const Eigen::Vector3d center = ends.first + (ends.second - ends.first) * i / (kRings - 1);
    const double s = model.axis.dot(center - at);
    Eigen::Matrix<double, 3, 6> jacobian;
    jacobian.leftCols<3>().setIdentity();
    for (int k = 0; k < 3; ++k) jacobian.col(3 + k) = s * Eigen::Vector3d::Unit(k).cross(model.axis);
    const Eigen::Matrix<double, 2, 6> errors = across.transpose() * jacobian;
    const Eigen::Matrix<double, 3, 2> half_axes =
        kConfidence * across * squareRoot(errors * model.covariance * errors.transpose());
    rings.push_back({center, half_axes.col(0), half_axes.col(1)});
  }
  return rings;
}

Eigen::Vector3d graspPoint(const core::LearnedModel& model) {
  if (!core::modelEntry(model.type).turns) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d edges[] = {
      {-model.width / 2, 0, 0}, {model.width / 2, 0, 0}, {0, -model.height / 2, 0}, {0, model.height / 2, 0}};
  const auto from_axis = [&](const Eigen::Vector3d& p_front) {
    return (model.origin * p_front - model.axis_point).cross(model.axis).norm();
  };
  return *std::max_element(std::begin(edges), std::end(edges),
                           [&](const auto& a, const auto& b) { return from_axis(a) < from_axis(b); });
}

void drawJoints(const std::vector<core::LearnedModel>& models, const std::vector<core::Track>& tracks, const JointStyle& style,
                Drawing* drawing) {
  double newest = 0;
  for (const core::LearnedModel& model : models) newest = std::max(newest, model.stamp);
  for (const core::LearnedModel& model : shownOf(core::allPlaced(models), style)) {
    const Color color = colorOf(model, style.color_by, newest - model.stamp);
    const core::Rectangle front = frontAt(model, model.q);
    addSurface(front, {color, isJoint(model) ? style.alpha : style.alpha / 2}, drawing);
    addOutline(front, {color}, drawing);
    if (isJoint(model)) drawJoint(model, tracks, style, color, drawing);
    if (!style.label) continue;
    drawing->texts.push_back({front.center(), isJoint(model) ? inLines(labelOf(model)) : shortLabelOf(model), {kInk}});
  }
}

}  // namespace cabinet_articulation
