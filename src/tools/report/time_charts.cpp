// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "articulation/models/model_registry.h"
#include "cabinet_articulation/joints/joint.h"
#include "geometry/degrees.h"
#include "geometry/median.h"
#include "geometry/palette.h"
#include "tools/report/front_charts.h"
#include "tools/terminal/words.h"

namespace cabinet_articulation {
namespace {

namespace palette = core::palette;

constexpr double kFaint = 0.01;  ///< no line for a type that never is more probable than this
constexpr Color kInk{0.15F, 0.15F, 0.15F}, kPale{0.93F, 0.91F, 0.86F};
constexpr double kCentimetres = 100;  ///< in a metre
constexpr double kBarHeight = 0.8;    ///< of a row

Layer unseenLayer(const FrontRecord& front, const Range& y) {
  Layer layer{Layer::kBars, "", kPale};
  if (!front.unseen.empty()) layer.name = "front not seen";
  layer.sets_range = false;
  for (const Range& gap : front.unseen) {
    layer.points.emplace_back(gap.from, y.from);
    layer.points.emplace_back(gap.to, y.to);
  }
  return layer;
}

void addFirstJoint(const FrontRecord& front, const Range& y, Chart* chart) {
  if (!front.first_joint) return;
  Layer layer{
      Layer::kLine, "first told to be a joint", kInk, 1, true, {{*front.first_joint, y.from}, {*front.first_joint, y.to}}};
  layer.sets_range = false;
  chart->layers.push_back(layer);
}

Range rangeOf(const std::vector<Eigen::Vector2d>& points) {
  Range range{0, 0};
  for (const Eigen::Vector2d& p : points) range = {std::min(range.from, p.y()), std::max(range.to, p.y())};
  const double margin = std::max(0.08 * range.span(), 0.1);
  return {range.from - margin, range.to + margin};
}

/// [s] between samples: more than a frame where they were thinned out.
double usualStep(const std::vector<FrontSample>& samples, double period) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < samples.size(); ++i) steps.push_back(samples[i].time - samples[i - 1].time);
  return std::max(core::median(steps), period);
}

Color mixed(const Color& a, const Color& b, float share) {
  Color color;
  for (std::size_t i = 0; i < 3; ++i) color[i] = (1 - share) * a[i] + share * b[i];
  return color;
}

/// From vermilion (not seen) through grey to blue (seen).
Color supportColor(float support) {
  const float s = std::clamp(support, 0.0F, 1.0F);
  constexpr Color kMiddle{0.87F, 0.87F, 0.87F};
  return s < 0.5F ? mixed(palette::kVermilion, kMiddle, 2 * s) : mixed(kMiddle, palette::kBlue, 2 * s - 1);
}

}  // namespace

double shownScale(const core::LearnedModel& model) {
  return core::modelEntry(model.type).unit == core::ConfigurationUnit::kRadian ? core::toDegrees(1) : kCentimetres;
}

const char* shownUnit(const core::LearnedModel& model) {
  return core::modelEntry(model.type).unit == core::ConfigurationUnit::kRadian ? "deg" : "cm";
}

std::string shownRange(const core::LearnedModel& model) {
  constexpr double kZero = 0.05;  // no minus before what is 0.0 in print
  const auto shown = [&model](double q) { return std::abs(shownScale(model) * q) < kZero ? 0 : shownScale(model) * q; };
  return format("%.1f to %.1f %s", shown(model.q_min), shown(model.q_max), shownUnit(model));
}

Chart openingChart(const FrontRecord& front, const TimeAxis& time) {
  const core::LearnedModel& model = front.model;
  const bool joint = core::wasJoint(model);
  Chart chart;
  chart.title = joint ? "Opening" : "Distance from the first place";
  chart.x_label = time.label;
  chart.y_label = "[" + std::string(joint ? shownUnit(model) : "cm") + "]";
  chart.x = time.range;
  Layer observed{Layer::kDots, "observed", joint ? colorOf(model) : palette::kOrange, 2.2};
  const std::vector<FrontSample> samples = front.observations.values();
  for (const FrontSample& sample : samples) {
    const double moved = kCentimetres * (sample.rectangle.center() - samples.front().rectangle.center()).norm();
    observed.points.emplace_back(sample.time, joint ? shownScale(model) * model.configuration(sample.rectangle.pose) : moved);
  }
  chart.y = rangeOf(observed.points);
  chart.layers.push_back(unseenLayer(front, *chart.y));
  for (const double q : {model.q_min, model.q_max}) {
    if (!joint) break;
    const double y = shownScale(model) * q;
    chart.layers.push_back(
        {Layer::kLine, q == model.q_min ? "range" : "", palette::kGrey, 1, true, {{time.range.from, y}, {time.range.to, y}}});
  }
  addFirstJoint(front, *chart.y, &chart);
  chart.layers.push_back(observed);
  return chart;
}

Chart probabilityChart(const FrontRecord& front, const TimeAxis& time) {
  constexpr Range kProbability{-0.03, 1.03};
  Chart chart;
  chart.title = "Probability of each type";
  chart.x_label = time.label;
  chart.x = time.range;
  chart.y = kProbability;
  chart.layers.push_back(unseenLayer(front, kProbability));
  addFirstJoint(front, kProbability, &chart);
  const std::vector<Opinion> opinions = front.opinions.values();
  for (const core::ModelEntry& entry : core::modelRegistry()) {
    Layer line{Layer::kLine, entry.name, entry.color, 2};
    const auto index = static_cast<std::size_t>(entry.type);
    double most = 0;
    for (const Opinion& opinion : opinions) {
      if (index >= opinion.probabilities.size()) continue;
      // Kept until the next frame.
      if (!line.points.empty()) line.points.emplace_back(opinion.time, line.points.back().y());
      line.points.emplace_back(opinion.time, opinion.probabilities[index]);
      most = std::max(most, opinion.probabilities[index]);
    }
    if (most > kFaint) chart.layers.push_back(line);
  }
  return chart;
}

Chart edgeChart(const FrontRecord& front, const Viewpoint& view, const TimeAxis& time) {
  Chart chart;
  chart.title = "How much of each edge was seen";
  chart.x_label = time.label;
  chart.x = time.range;
  const std::array<Side, 4> sides = sidesOf(front.model, view);
  for (const Side side : {kUpper, kLower, kLeft, kRight}) chart.rows.emplace_back(nameOf(side));
  const std::vector<FrontSample> samples = front.observations.values();
  const double half = usualStep(samples, time.period) / 2;
  Layer bars{Layer::kBars, "", {}};
  for (const FrontSample& sample : samples) {
    for (std::size_t edge = 0; edge < sides.size(); ++edge) {
      bars.points.emplace_back(sample.time - half, sides[edge] - kBarHeight / 2);
      bars.points.emplace_back(sample.time + half, sides[edge] + kBarHeight / 2);
      bars.colors.push_back(supportColor(sample.edge_support[edge]));
    }
  }
  chart.layers = {{Layer::kBars, "whole", supportColor(1)},
                  {Layer::kBars, "half", supportColor(0.5F)},
                  {Layer::kBars, "nothing", supportColor(0)}};
  chart.layers.push_back(bars);
  return chart;
}

}  // namespace cabinet_articulation
