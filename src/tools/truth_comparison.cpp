// SPDX-License-Identifier: BSD-3-Clause
#include "tools/truth_comparison.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <set>

#include "articulation/models/model_registry.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "geometry/degrees.h"

namespace cabinet_articulation {
namespace {

constexpr double kMillimetres = 1e3;
std::string line(const char* format, ...) __attribute__((format(printf, 1, 2)));
std::string line(const char* format, ...) {
  char buffer[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof(buffer), format, arguments);
  va_end(arguments);
  return buffer;
}

}  // namespace

const char* typeName(int type) {
  const auto index = static_cast<size_t>(type);
  return index < core::modelRegistry().size() ? core::modelRegistry()[index].name : "unknown";
}

double distanceToModel(const core::LearnedModel& model, const core::Rectangle& front) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < core::kDescriptions; ++k) {
    const double q = model.configuration(core::describe(front, k).pose);
    least = std::min(least, (model.predict(q).translation() - front.center()).norm());
  }
  return least;
}

bool SceneComparison::right() const {
  return false_movers == 0 && std::all_of(joints.begin(), joints.end(), [](const JointComparison& joint) { return joint.right; });
}

void TruthComparison::add(const SceneTruth& truth) {
  for (const JointTruth& joint : truth.joints) {
    if (!histories_.count(joint.name)) order_.push_back(joint.name);
    History& history = histories_[joint.name];
    history.q_min = history.fronts.empty() ? joint.q : std::min(history.q_min, joint.q);
    history.q_max = history.fronts.empty() ? joint.q : std::max(history.q_max, joint.q);
    history.last = joint;
    history.fronts.push_back({fromMessage(joint.pose), joint.width, joint.height});
  }
}

JointComparison TruthComparison::compareJoint(const History& truth, const ArticulationModel& model) const {
  JointComparison result;
  result.name = truth.last.name;
  result.true_type = truth.last.type;
  result.true_range = truth.q_max - truth.q_min;
  result.model = model;
  result.probability = model.type < model.probabilities.size() ? model.probabilities[model.type] : 0;
  const core::LearnedModel learned = fromMessage(model);
  for (const core::Rectangle& front : truth.fronts) {
    const double distance = kMillimetres * distanceToModel(learned, front);
    result.prediction_mean += distance / truth.fronts.size();
    result.prediction_max = std::max(result.prediction_max, distance);
  }
  const Eigen::Vector3d true_axis = fromMessage(truth.last.axis).normalized();
  result.axis_degrees = core::toDegrees(std::acos(std::min(1.0, std::abs(true_axis.dot(learned.axis)))));
  if (truth.last.type == ArticulationModel::ROTATIONAL) {
    const Eigen::Vector3d offset = learned.axis_point - fromMessage(truth.last.axis_point);
    result.axis_millimetres = kMillimetres * (offset - true_axis.dot(offset) * true_axis).norm();
  }
  return result;
}

SceneComparison TruthComparison::compare(const std::vector<ArticulationModel>& models, const TruthLimits& limits) const {
  SceneComparison comparison;
  std::set<std::uint32_t> used;
  for (const std::string& name : order_) {
    const History& history = histories_.at(name);
    if (history.q_max <= history.q_min) continue;
    JointComparison best;
    best.name = name;
    best.true_type = history.last.type;
    best.true_range = history.q_max - history.q_min;
    best.prediction_mean = std::numeric_limits<double>::infinity();
    for (const ArticulationModel& model : models) {
      if (!model.moved) continue;
      const JointComparison candidate = compareJoint(history, model);
      if (candidate.prediction_mean < best.prediction_mean) best = candidate;
    }
    best.found = best.prediction_mean < kMillimetres * kFoundWithin;
    best.right = best.found && best.model.type == best.true_type && best.probability > limits.probability &&
                 best.axis_degrees <= limits.axis_degrees && best.axis_millimetres <= limits.axis_millimetres &&
                 best.prediction_max <= limits.prediction_millimetres;
    if (best.found) used.insert(best.model.id);
    comparison.joints.push_back(best);
  }
  for (const ArticulationModel& model : models)
    if (model.moved && model.type != ArticulationModel::RIGID && !used.count(model.id)) ++comparison.false_movers;
  return comparison;
}

std::string format(const SceneComparison& comparison) {
  std::string text = line("%-16s %-11s %4s %-11s %6s %9s %9s %15s %12s %6s\n", "true joint", "true type", "id", "learned", "P",
                          "axis deg", "axis mm", "front mm (max)", "range", "");
  for (const JointComparison& joint : comparison.joints) {
    if (!joint.found) {
      text += line("%-16s %-11s no learned model describes it\n", joint.name.c_str(), typeName(joint.true_type));
      continue;
    }
    const bool turns = joint.true_type == ArticulationModel::ROTATIONAL;
    const double scale = turns ? core::toDegrees(1) : kMillimetres;
    text += line("%-16s %-11s %4u %-11s %6.3f %9.2f %9s %7.1f (%5.1f) %5.0f of %4.0f %s %6s\n", joint.name.c_str(),
                 typeName(joint.true_type), joint.model.id, typeName(joint.model.type), joint.probability, joint.axis_degrees,
                 turns ? line("%.1f", joint.axis_millimetres).c_str() : "-", joint.prediction_mean, joint.prediction_max,
                 scale * (joint.model.q_max - joint.model.q_min), scale * joint.true_range, turns ? "deg" : "mm",
                 joint.right ? "right" : "WRONG");
  }
  text += line("objects called moving that stand still: %d\n", comparison.false_movers);
  return text;
}

}  // namespace cabinet_articulation
