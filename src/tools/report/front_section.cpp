// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/front_section.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "articulation/models/model_registry.h"
#include "cabinet_articulation/joints/joint.h"
#include "geometry/degrees.h"
#include "geometry/median.h"
#include "tools/report/front_charts.h"
#include "tools/report/html.h"
#include "tools/report/svg_canvas.h"
#include "tools/terminal/words.h"

namespace cabinet_articulation {
namespace {

constexpr double kMillimetres = 1000, kCentimetres = 100;               ///< in a metre
constexpr double kTimesWide = 560, kTimesHigh = 290, kEdgesHigh = 210;  ///< [px]
constexpr double kViewWide = 540, kViewHigh = 395;
constexpr std::size_t kGapsNamed = 5;

std::string anchorOf(const core::LearnedModel& model) { return "front" + std::to_string(model.id); }

std::string titleOf(const core::LearnedModel& model) {
  const std::string title = "Front " + std::to_string(model.id);
  return model.name.empty() ? title : title + ", " + model.name;
}

std::string typeText(const core::LearnedModel& model) {
  if (!core::wasJoint(model)) return "moved, but no joint fits";
  std::string text = format("%s, %.1f %%", core::modelName(model.type), 100 * core::typeProbability(model));
  if (core::isGivenUp(model)) text += ", given up: as many observations speak against it as for it";
  return text;
}

std::string swatch(const core::LearnedModel& model) {
  const Color color = colorOf(model);
  return format("<span class=\"swatch\" style=\"background: rgb(%.0f, %.0f, %.0f)\"></span>", 255.0 * color[0], 255.0 * color[1],
                255.0 * color[2]);
}

std::string endsText(const core::LearnedModel& model) {
  const auto end = [](bool is_end) { return is_end ? "an end of the way" : "merely reached"; };
  return shownRange(model) + " (" + end(model.q_min_is_end) + "; " + end(model.q_max_is_end) + ")";
}

std::string closedText(const core::LearnedModel& model) {
  if (!model.closed_known) return "not known";
  return format("at %.1f %s", shownScale(model) * model.q_closed, shownUnit(model));
}

std::string sizeText(const core::LearnedModel& model) {
  return format("%.1f &#215; %.1f cm", kCentimetres * model.width, kCentimetres * model.height);
}

/// The standard deviation in the most uncertain direction across the axis: along it, no place and no turn is another axis.
double largestSigma(const core::Matrix6d& covariance, Eigen::Index first, const Eigen::Vector3d& axis) {
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - axis * axis.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(across * covariance.block<3, 3>(first, first) * across);
  return std::sqrt(std::max(solver.eigenvalues().maxCoeff(), 0.0));
}

std::string axisError(const core::LearnedModel& model) {
  if (!core::wasJoint(model)) return "";
  const std::string turn = format("&#177; %.1f deg", core::toDegrees(largestSigma(model.covariance, 3, model.axis)));
  if (!core::modelEntry(model.type).turns) return turn;
  return turn + format(", &#177; %.1f mm", kMillimetres * largestSigma(model.covariance, 0, model.axis));
}

std::string vectorText(const Eigen::Vector3d& v) { return format("(%.3f, %.3f, %.3f)", v.x(), v.y(), v.z()); }

std::string axisText(const core::LearnedModel& model, const std::string& frame) {
  std::string text = "along " + vectorText(model.axis);
  if (core::modelEntry(model.type).turns)
    text += " through " + vectorText(model.axis_point) + format(", %.1f cm from the front's centre", kCentimetres * model.radius);
  return text + " in " + escaped(frame) + "; " + axisError(model);
}

std::string residualText(const core::LearnedModel& model) {
  return format("%.1f mm, %.2f deg", kMillimetres * model.position_error, core::toDegrees(model.orientation_error));
}

/// The longest gaps, in the order of time.
std::string unseenText(std::vector<Range> gaps, double end) {
  if (gaps.empty()) return "never: seen in all frames";
  double sum = 0;
  for (const Range& gap : gaps) sum += gap.span();
  const std::size_t all = gaps.size();
  std::stable_sort(gaps.begin(), gaps.end(), [](const Range& a, const Range& b) { return a.span() > b.span(); });
  gaps.resize(std::min(gaps.size(), kGapsNamed));
  std::sort(gaps.begin(), gaps.end(), [](const Range& a, const Range& b) { return a.from < b.from; });
  std::string text;
  for (const Range& gap : gaps) {
    text += text.empty() ? "" : ", ";
    if (gap.from <= 0)
      text += format("before %.1f s", gap.to);
    else
      text += gap.to >= end ? format("after %.1f s", gap.from) : format("%.1f to %.1f s", gap.from, gap.to);
  }
  if (all > gaps.size()) text += format(" and %zu shorter times", all - gaps.size());
  return text + format("; %.1f s in all", sum);
}

/// The median share of each edge.
std::string edgesText(const FrontRecord& front, const Viewpoint& view) {
  const std::array<Side, 4> sides = sidesOf(front.model, view);
  std::array<double, 4> shares{};
  for (std::size_t edge = 0; edge < sides.size(); ++edge) {
    std::vector<double> values;
    for (const FrontSample& sample : front.observations.values()) values.push_back(sample.edge_support[edge]);
    shares[sides[edge]] = core::median(values);
  }
  std::string text;
  for (const Side side : {kUpper, kLower, kLeft, kRight})
    text += format("%s%s %.0f %%", text.empty() ? "" : ", ", nameOf(side), 100 * shares[side]);
  return text + " (median)";
}

using Facts = std::vector<std::pair<std::string, std::string>>;

Facts factsOf(const FrontRecord& front, const Viewpoint& view, const RunFacts& run, const RunRecord& record) {
  const core::LearnedModel& model = front.model;
  const std::string frame = model.parent == 0 ? run.fixed_frame : format("the frame of front %u", model.parent);
  Facts facts{{"Type", swatch(model) + typeText(model)}};
  if (core::wasJoint(model)) {
    facts.insert(facts.end(), {{"Opening", endsText(model)},
                               {"Closed", closedText(model)},
                               {"Axis", axisText(model, frame)},
                               {"Residuals", residualText(model) + " in the mean"}});
  }
  facts.insert(facts.end(),
               {{"Size", sizeText(model)},
                {"Observations", format("%d, from %.1f to %.1f s", model.observations, front.first_seen, front.last_seen)},
                {"First told", front.first_joint ? format("at %.1f s", *front.first_joint) : "never"},
                {"Not seen", unseenText(front.unseen, record.end())},
                {"Edges seen", edgesText(front, view)}});
  if (model.parent != 0)
    facts.emplace_back("Hangs on", format("front %u, %.0f %%; charts are in its frame, with what was seen since %.1f s",
                                          model.parent, 100 * model.parent_probability, front.hangs_since.value_or(0)));
  return facts;
}

}  // namespace

std::vector<std::string> frontColumns() { return {"front", "type", "opening", "size", "axis", "residuals", "observations"}; }

std::string frontRow(const FrontRecord& front) {
  const core::LearnedModel& model = front.model;
  return tableRow("td", {swatch(model) + "<a href=\"#" + anchorOf(model) + "\">" + escaped(titleOf(model)) + "</a>",
                         typeText(model), core::wasJoint(model) ? shownRange(model) : "", sizeText(model), axisError(model),
                         core::wasJoint(model) ? residualText(model) : "", std::to_string(model.observations)});
}

std::string frontSection(const FrontRecord& front, const RunFacts& facts, const RunRecord& record, const Picture* first) {
  const Viewpoint view = beforeTheFront(front.model, front.turn.transpose() * facts.upwards);
  const TimeAxis time{"time [s]", {0, std::max(record.end(), record.period())}, record.period()};
  std::string html = "<h2 id=\"" + anchorOf(front.model) + "\">" + escaped(titleOf(front.model)) + "</h2>\n";
  html += "<div class=\"row\">\n<div class=\"left\">\n" + factTable(factsOf(front, view, facts, record)) + "</div>\n";
  if (first != nullptr)
    html += "<figure class=\"right\">" + jpegElement(first->jpeg, "the frame that told this joint first") +
            format("<figcaption>%.1f s: told to be a joint for the first time</figcaption></figure>\n", first->time);
  html += "</div>\n<div class=\"row\">\n<div class=\"left\">\n";
  html += chartElement(openingChart(front, time), kTimesWide, kTimesHigh) + "\n";
  html += chartElement(probabilityChart(front, time), kTimesWide, kTimesHigh) + "\n";
  html += chartElement(edgeChart(front, view, time), kTimesWide, kEdgesHigh) + "</div>\n<div class=\"right\">\n";
  html += chartElement(topChart(front, view), kViewWide, kViewHigh) + "\n";
  return html + chartElement(sideChart(front, view), kViewWide, kViewHigh) + "</div>\n</div>\n";
}

}  // namespace cabinet_articulation
