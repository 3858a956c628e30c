// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/page.h"

#include <algorithm>

#include "geometry/palette.h"
#include "tools/report/html.h"
#include "tools/report/svg_canvas.h"
#include "tools/terminal/words.h"

namespace cabinet_articulation {
namespace {

std::string count(std::size_t number, const std::string& what) {
  return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

std::string heading(const RunFacts& facts, const RunRecord& record, const RunSummary& summary) {
  const std::string found = count(record.moved().size(), "front") + " moved, " + std::to_string(summary.still()) + " did not";
  std::string html = element("h1", "Doors and drawers in " + facts.bag);
  html += element("p",
                  count(static_cast<std::size_t>(record.frames()), "frame") + format(" in %.1f s. ", record.end()) + found + ".");
  html += factTable({{"Command", "<code>" + escaped(facts.command) + "</code>"},
                     {"Input", escaped(facts.input)},
                     {"Poses are in", escaped(facts.fixed_frame)}});
  if (record.leftOut() > 0)
    html += element("p", count(static_cast<std::size_t>(record.leftOut()), "further front") +
                             " moved for the shortest time and were left out.");
  if (!facts.troubles.empty()) html += "<p class=\"note\">" + escaped(facts.troubles) + "</p>\n";
  return html;
}

std::string jointTable(const RunRecord& record) {
  if (record.moved().empty()) return element("h2", "Joints") + element("p", "Nothing moved.");
  std::string html = element("h2", "Joints") + "<table>\n" + tableRow("th", frontColumns());
  for (const FrontRecord* front : record.moved()) html += frontRow(*front);
  return html +
         "</table>\n<p class=\"note\">Opening: 0 is the first place seen; where it is closed is said in its section. Axis: "
         "standard deviation of its direction and place. Residuals: mean distance of the observations from the joint.</p>\n";
}

std::string frames(const FramePictures& pictures) {
  std::string html =
      element("h2", "Frames") +
      "<p class=\"note\">Yellow: rectangles of the frame. Thick: fronts as they are known. Vermilion: axes. White: the "
      "way from the first place. A click enlarges.</p>\n<div class=\"frames\">\n";
  for (const Picture& picture : pictures.evenlySpaced()) {
    const std::string time = format("%.1f s", picture.time);
    html += "<details><summary>" + jpegElement(picture.jpeg, "the frame at " + time) + "<span class=\"note\">" + time +
            "</span></summary></details>\n";
  }
  return html + "</div>\n";
}

Chart timesChart(const RunRecord& record) {
  namespace palette = core::palette;
  const std::vector<std::pair<Layer, double core::StageTimes::*>> stages{
      {{Layer::kLine, "stereo", palette::kBlue, 1.5}, &core::StageTimes::stereo},
      {{Layer::kLine, "planes", palette::kOrange, 1.5}, &core::StageTimes::planes},
      {{Layer::kLine, "rectangles", palette::kBluishGreen, 1.5}, &core::StageTimes::rectangles},
      {{Layer::kLine, "tracking", palette::kSkyBlue, 1.5}, &core::StageTimes::tracking},
      {{Layer::kLine, "articulation", palette::kVermilion, 1.5}, &core::StageTimes::articulation}};
  Chart chart;
  chart.title = "Each frame";
  chart.x_label = "time [s]";
  chart.y_label = "[ms]";
  double longest = 0;
  for (const auto& [layer, stage] : stages) {
    chart.layers.push_back(layer);
    for (const FrameTimes& frame : record.times()) {
      chart.layers.back().points.emplace_back(frame.time, frame.milliseconds.*stage);
      longest = std::max(longest, frame.milliseconds.*stage);
    }
  }
  chart.y = Range{0, 1.05 * std::max(longest, 1.0)};
  return chart;
}

std::string times(const RunRecord& record, const RunSummary& summary) {
  std::string html = element("h2", "Times") + "<div class=\"row\">\n<table>\n" +
                     tableRow("th", {"stage", "median [ms]", "mean [ms]", "longest [ms]"});
  for (const StageSummary& stage : summary.stages())
    html += tableRow("td", {stage.name, format("%.2f", stage.median), format("%.2f", stage.mean), format("%.2f", stage.longest)});
  return html + "</table>\n" + chartElement(timesChart(record), 620, 260) + "</div>\n";
}

}  // namespace

std::string reportPage(const RunFacts& facts, const RunRecord& record, const FramePictures& pictures, const RunSummary& summary) {
  std::string body = heading(facts, record, summary) + jointTable(record) + frames(pictures);
  for (const FrontRecord* front : record.moved()) body += frontSection(*front, facts, record, pictures.firstOf(front->model.id));
  return document("Doors and drawers in " + facts.bag, body + times(record, summary));
}

}  // namespace cabinet_articulation
