// SPDX-License-Identifier: BSD-3-Clause
#include "ros/drawing/model_drawing.h"

#include <cmath>
#include <cstdio>

#include "articulation/models/model_registry.h"
#include "cabinet_articulation/joints/joint.h"
#include "geometry/degrees.h"

namespace cabinet_articulation {
namespace {

constexpr int kWaySteps = 16;

}  // namespace

Color colorOf(const core::LearnedModel& model) {
  if (!model.moved) return core::palette::kGrey;
  if (!isJoint(model)) return core::palette::kOrange;
  return core::modelEntry(model.type).color;
}

bool countsRadians(const core::LearnedModel& model) {
  return core::modelEntry(model.type).unit == core::ConfigurationUnit::kRadian;
}

std::string shortLabelOf(const core::LearnedModel& model) {
  return std::to_string(model.id) + (model.name.empty() ? "" : " " + model.name);
}

std::vector<std::string> labelLines(const std::string& label) {
  const std::size_t comma = label.find(", ");
  if (comma == std::string::npos) return {label};
  return {label.substr(0, comma), label.substr(comma + 2)};
}

std::string labelOf(const core::LearnedModel& model) {
  const std::string front = shortLabelOf(model);
  const double probability = core::typeProbability(model);
  char text[128], opening[16] = "";
  if (!model.moved && !model.observed) {
    std::snprintf(text, sizeof(text), " %s %.0f %% expected", core::modelName(model.type), 100 * probability);
    return front + text;
  }
  if (!model.moved) return front + " no motion yet";
  if (!isJoint(model)) return front + " moved, no joint fits";
  const double scale = countsRadians(model) ? core::toDegrees(1) : 100;
  // Rounded first: what is next to nothing has no sign.
  const auto rounded = [scale](double q) { return std::round(scale * q) + 0.0; };
  if (model.closed_known) std::snprintf(opening, sizeof(opening), ", %.0f %% open", 100 * model.opening);
  std::snprintf(text, sizeof(text), " %s %.0f %%%s, %.0f %s (%.0f to %.0f)", core::modelName(model.type), 100 * probability,
                opening, rounded(model.q), countsRadians(model) ? "deg" : "cm", rounded(model.q_min), rounded(model.q_max));
  return front + text;
}

std::pair<Eigen::Vector3d, Eigen::Vector3d> axisOf(const core::LearnedModel& model) {
  if (!core::modelEntry(model.type).turns)
    return {model.predict(model.q_min).translation(), model.predict(model.q_max).translation()};
  // As long as the front is along the hinge.
  const Eigen::Vector3d in_front = model.origin.linear().transpose() * model.axis;
  const double half = (std::abs(in_front.x()) * model.width + std::abs(in_front.y()) * model.height) / 2;
  return {model.axis_point - half * model.axis, model.axis_point + half * model.axis};
}

std::vector<Eigen::Vector3d> wayOf(const core::LearnedModel& model, double from, double to) {
  std::vector<Eigen::Vector3d> way;
  for (int i = 0; i <= kWaySteps; ++i) way.push_back(model.predict(from + (to - from) * i / kWaySteps).translation());
  return way;
}

std::vector<core::Rectangle> sweepOf(const core::LearnedModel& model, int steps) {
  std::vector<core::Rectangle> fronts;
  if (!isJoint(model)) return fronts;
  for (int i = 0; i <= steps; ++i) fronts.push_back(frontAt(model, model.q_min + (model.q_max - model.q_min) * i / steps));
  return fronts;
}

}  // namespace cabinet_articulation
