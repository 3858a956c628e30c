// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/joint_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "articulation/models/model_registry.h"
#include "cabinet_articulation/joints/joint.h"
#include "geometry/degrees.h"
#include "ros/drawing/overlay_labels.h"
#include "rviz_plugin/display_colors.h"

namespace cabinet_articulation {
namespace {

constexpr double kClosed = 0.02;  ///< ours: as far open as one sees a door to be closed

std::string percent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

/// Rounded first: what is next to nothing has no sign.
std::string number(const core::LearnedModel& model, double q) {
  if (countsRadians(model)) return std::to_string(std::lround(core::toDegrees(q)));
  char text[32];
  std::snprintf(text, sizeof(text), "%.1f", std::round(1000 * q) / 10 + 0.0);
  return text;
}

const char* unitOf(const core::LearnedModel& model) { return countsRadians(model) ? " deg" : " cm"; }

bool hasRow(const core::LearnedModel& model) { return model.moved || !model.observed || !model.name.empty(); }

std::string parentOf(const core::LearnedModel& model, const std::vector<core::LearnedModel>& models) {
  const auto parent = std::find_if(models.begin(), models.end(), [&](const auto& other) { return other.id == model.parent; });
  return parent == models.end() ? "front_" + std::to_string(model.parent) : nameOf(*parent);
}

std::string stateOf(const core::LearnedModel& model, const std::vector<core::LearnedModel>& models) {
  if (isGivenUp(model)) return "given up: it was seen elsewhere";
  if (!model.observed) return "expected, never seen to move";
  if (!model.moved) return "no motion yet";
  if (!isJoint(model)) return "moved, no joint fits";
  std::string state = "never seen closed";
  if (model.closed_known) state = model.opening <= kClosed ? "closed" : "open";
  if (model.parent != 0) state += ", hangs on " + parentOf(model, models) + " (" + percent(model.parent_probability) + ")";
  if (model.hollow) state += ", a frame around a hole";
  return state;
}

std::string allProbabilities(const core::LearnedModel& model) {
  std::string text;
  for (std::size_t i = 0; i < model.probabilities.size() && i < core::modelRegistry().size(); ++i) {
    if (!text.empty()) text += "\n";
    text += std::string(core::modelRegistry()[i].name) + " " + percent(model.probabilities[i]);
  }
  return text;
}

JointRow rowOf(const core::LearnedModel& model, const std::vector<core::LearnedModel>& models) {
  JointRow row;
  row.id = model.id;
  row.name = nameOf(model);
  row.state = stateOf(model, models);
  row.probabilities = allProbabilities(model);
  if (!isJoint(model)) return row;
  row.type = std::string(core::modelName(model.type)) + " " + percent(typeProbability(model));
  row.opening = gaugeOf(model)->opening;
  row.q = configurationText(model, model.q);
  row.range = number(model, model.q_min) + " to " + configurationText(model, model.q_max);
  return row;
}

}  // namespace

std::string configurationText(const core::LearnedModel& model, double q) { return number(model, q) + unitOf(model); }

std::vector<JointRow> jointRows(const std::vector<core::LearnedModel>& models) {
  std::vector<JointRow> rows;
  for (const core::LearnedModel& model : models)
    if (hasRow(model)) rows.push_back(rowOf(model, models));
  std::sort(rows.begin(), rows.end(), [](const JointRow& a, const JointRow& b) { return a.id < b.id; });
  return rows;
}

std::string summaryOf(const std::vector<core::LearnedModel>& models) {
  const auto joints = std::count_if(models.begin(), models.end(), core::isJoint);
  const auto resting = std::count_if(models.begin(), models.end(), [](const auto& model) { return !model.moved; });
  return std::to_string(joints) + (joints == 1 ? " joint; " : " joints; ") + std::to_string(resting) +
         (resting == 1 ? " front did not move" : " fronts did not move");
}

}  // namespace cabinet_articulation
