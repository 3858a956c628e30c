// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run_summary.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "articulation/models/model_registry.h"
#include "geometry/degrees.h"

namespace cabinet_articulation {
namespace {

template <class... Arguments>
std::string format(const char* pattern, Arguments... arguments) {
  char text[256];
  std::snprintf(text, sizeof text, pattern, arguments...);
  return text;
}

std::string vectorText(const Eigen::Vector3d& v) { return format("(%.3f %.3f %.3f)", v.x(), v.y(), v.z()); }

std::string modelText(const core::LearnedModel& model) {
  const core::ModelEntry& entry = core::modelEntry(model.type);
  std::string text = format("object %u: %s, %.3f x %.3f m, %d observations\n  probabilities", model.id,
                            model.explained ? entry.name : "none of these", model.width, model.height, model.observations);
  for (const double probability : model.probabilities) text += format(" %.3f", probability);
  if (entry.moves) text += "\n  axis " + vectorText(model.axis);
  if (entry.turns) text += " through " + vectorText(model.axis_point) + format(", radius %.3f m", model.radius);
  if (entry.moves && entry.unit == core::ConfigurationUnit::kRadian)
    text += format(", opening %.1f to %.1f deg", core::toDegrees(model.q_min), core::toDegrees(model.q_max));
  else if (entry.moves)
    text += format(", opening %.3f to %.3f m", model.q_min, model.q_max);
  return text + format("\n  residuals %.1f mm, %.2f deg\n", 1e3 * model.position_error, core::toDegrees(model.orientation_error));
}

}  // namespace

void RunSummary::add(const core::PipelineResult& result) {
  milliseconds_.push_back(result.milliseconds);
  for (const core::LearnedModel& model : result.models) models_[model.id] = model;
}

std::string RunSummary::objects() const {
  std::string text;
  int still = 0;
  for (const auto& [id, model] : models_) {
    if (model.moved)
      text += modelText(model);
    else
      ++still;
  }
  if (text.empty()) text = "nothing moved\n";
  return text + format("%d other rectangles did not move\n", still);
}

std::string RunSummary::timing() const {
  static constexpr std::pair<const char*, double core::StageTimes::*> kStages[] = {
      {"stereo", &core::StageTimes::stereo},
      {"planes", &core::StageTimes::planes},
      {"rectangles", &core::StageTimes::rectangles},
      {"tracking", &core::StageTimes::tracking},
      {"articulation", &core::StageTimes::articulation},
  };
  std::string text = "stage          median    mean [ms]\n";
  std::vector<double> totals(milliseconds_.size(), 0);
  const auto line = [](const char* name, std::vector<double> values) {
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / values.size();
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return format("%-12s %8.2f %7.2f\n", name, values[values.size() / 2], mean);
  };
  if (milliseconds_.empty()) return text;
  for (const auto& [name, stage] : kStages) {
    std::vector<double> values;
    for (size_t i = 0; i < milliseconds_.size(); ++i) {
      values.push_back(milliseconds_[i].*stage);
      totals[i] += values.back();
    }
    text += line(name, values);
  }
  return text + line("all", totals);
}

}  // namespace cabinet_articulation
