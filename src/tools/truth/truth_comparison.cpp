// SPDX-License-Identifier: BSD-3-Clause
#include "tools/truth/truth_comparison.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <set>

#include "articulation/models/model_registry.h"
#include "cabinet_articulation/joints/hanging.h"
#include "cabinet_articulation/joints/joint.h"
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

namespace {

struct Nearest {
  double q = 0;
  double distance = std::numeric_limits<double>::infinity();  ///< [m] between the centres
};

Nearest nearestTo(const core::LearnedModel& model, const core::Rectangle& front) {
  Nearest nearest;
  for (int k = 0; k < core::kDescriptions; ++k) {
    const double q = model.configuration(core::describe(front, k).pose);
    const double distance = (model.predict(q).translation() - front.center()).norm();
    if (distance < nearest.distance) nearest = {q, distance};
  }
  return nearest;
}

}  // namespace

double distanceToModel(const core::LearnedModel& model, const core::Rectangle& front) { return nearestTo(model, front).distance; }

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

/// The parent was at the q at which it is nearest to the true front that it describes best.
TruthComparison::Placed TruthComparison::placeModel(const ArticulationModel& model,
                                                    const std::vector<ArticulationModel>& all) const {
  Placed placed{fromMessage(model), {}};
  const auto parent = std::find_if(all.begin(), all.end(), [&](const auto& other) { return other.id == model.parent; });
  if (model.parent == 0 || parent == all.end()) return placed;
  const core::LearnedModel carrier = fromMessage(*parent);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [name, truth] : histories_) {
    double sum = 0;
    std::vector<Eigen::Isometry3d> frames;
    for (const core::Rectangle& front : truth.fronts) {
      const Nearest nearest = nearestTo(carrier, front);
      sum += nearest.distance;
      frames.push_back(carrier.predict(nearest.q));
    }
    if (sum >= least) continue;
    least = sum;
    placed.frames = std::move(frames);
  }
  return placed;
}

JointComparison TruthComparison::compareJoint(const History& truth, const ArticulationModel& model, const Placed& placed) const {
  JointComparison result;
  result.name = truth.last.name;
  result.true_type = truth.last.type;
  result.true_range = truth.q_max - truth.q_min;
  result.model = model;
  result.probability = core::typeProbability(placed.model);
  const bool follows = placed.frames.size() == truth.fronts.size();
  const core::LearnedModel learned = follows ? transformed(placed.model, placed.frames.back()) : placed.model;
  for (std::size_t i = 0; i < truth.fronts.size(); ++i) {
    core::Rectangle front = truth.fronts[i];
    if (follows) front.pose = placed.frames[i].inverse() * front.pose;
    const double distance = kMillimetres * distanceToModel(placed.model, front);
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
  std::vector<Placed> placed;
  for (const ArticulationModel& model : models) placed.push_back(placeModel(model, models));
  for (const std::string& name : order_) {
    const History& history = histories_.at(name);
    if (history.q_max <= history.q_min) continue;
    JointComparison best;
    best.name = name;
    best.true_type = history.last.type;
    best.true_range = history.q_max - history.q_min;
    best.prediction_mean = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < models.size(); ++i) {
      if (!models[i].moved) continue;
      const JointComparison candidate = compareJoint(history, models[i], placed[i]);
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
