// SPDX-License-Identifier: BSD-3-Clause
#include "tools/results/run_summary.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "articulation/models/model_registry.h"
#include "geometry/degrees.h"
#include "geometry/median.h"
#include "tools/terminal/words.h"

namespace cabinet_articulation {
namespace {

std::string vectorText(const Eigen::Vector3d& v) { return format("(%.3f %.3f %.3f)", v.x(), v.y(), v.z()); }

std::string modelText(const core::LearnedModel& model) {
  const core::ModelEntry& entry = core::modelEntry(model.type);
  std::string text = format("object %u: %s, %.3f x %.3f m, %d observations\n  probabilities", model.id,
                            model.explained ? entry.name : "none of these", model.width, model.height, model.observations);
  for (const double probability : model.probabilities) text += format(" %.3f", probability);
  if (model.parent != 0)
    text += format("\n  hangs on object %u, P %.3f, and is described in its frame", model.parent, model.parent_probability);
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
  for (const auto& [id, model] : models_)
    if (model.moved) text += modelText(model);
  if (text.empty()) text = "nothing moved\n";
  return text + format("%d other rectangles did not move\n", still());
}

int RunSummary::still() const {
  return static_cast<int>(std::count_if(models_.begin(), models_.end(), [](const auto& entry) { return !entry.second.moved; }));
}

std::vector<StageSummary> RunSummary::stages() const {
  static constexpr std::pair<const char*, double core::StageTimes::*> kStages[] = {
      {"stereo", &core::StageTimes::stereo},
      {"planes", &core::StageTimes::planes},
      {"rectangles", &core::StageTimes::rectangles},
      {"tracking", &core::StageTimes::tracking},
      {"articulation", &core::StageTimes::articulation},
  };
  std::vector<StageSummary> stages;
  if (milliseconds_.empty()) return stages;
  const auto add = [&stages](const char* name, const std::vector<double>& values) {
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / values.size();
    stages.push_back({name, core::median(values), mean, *std::max_element(values.begin(), values.end())});
  };
  std::vector<double> totals(milliseconds_.size(), 0);
  for (const auto& [name, stage] : kStages) {
    std::vector<double> values;
    for (size_t i = 0; i < milliseconds_.size(); ++i) {
      values.push_back(milliseconds_[i].*stage);
      totals[i] += values.back();
    }
    add(name, values);
  }
  add("all", totals);
  return stages;
}

std::string RunSummary::timing() const {
  std::string text = "stage          median    mean [ms]\n";
  for (const StageSummary& stage : stages()) text += format("%-12s %8.2f %7.2f\n", stage.name, stage.median, stage.mean);
  return text;
}

}  // namespace cabinet_articulation
