// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/terminal/words.h"

namespace cabinet_articulation {
namespace {

constexpr Color kFrame{0.6F, 0.6F, 0.6F}, kGrid{0.9F, 0.9F, 0.9F};
constexpr double kLine = 16;          ///< [px] height of a line of text
constexpr double kMargin = 0.04;      ///< of a range, beyond the data
constexpr double kSwatch = 18;        ///< [px] a sample of a layer in the legend
constexpr double kLabelRoom = 52;     ///< [px] left of the plot
constexpr double kTickDistance = 55;  ///< [px] at least

/// That of the finite points, with a margin; something to see also for a single point.
Range rangeOf(const Chart& chart, int axis) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Layer& layer : chart.layers) {
    if (!layer.sets_range) continue;
    for (const Eigen::Vector2d& p : layer.points) {
      if (!p.allFinite()) continue;
      range = {std::min(range.from, p[axis]), std::max(range.to, p[axis])};
    }
  }
  if (range.from > range.to) return {0, 1};
  const double margin = range.span() > 1e-9 ? kMargin * range.span() : 0.01;
  return {range.from - margin, range.to + margin};
}

Range widened(const Range& range, double span) {
  const double more = (span - range.span()) / 2;
  return {range.from - more, range.to + more};
}

std::string tickText(double value, double step) {
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  return format("%.*f", decimals, std::abs(value) < step / 2 ? 0 : value);
}

/// As many lines as the names need. Returns the height used [px].
double drawLegend(const Chart& chart, const Box& box, Canvas* canvas) {
  double x = box.left, y = box.top;
  bool any = false;
  for (const Layer& layer : chart.layers) {
    if (layer.name.empty()) continue;
    const double width = kSwatch + 6 + canvas->widthOf(layer.name) + 14;
    if (any && x + width > box.right()) {
      x = box.left;
      y += kLine;
    }
    any = true;
    const Eigen::Vector2d middle(x + kSwatch / 2, y + kLine / 2);
    if (layer.kind == Layer::kLine)
      canvas->line({{x, middle.y()}, {x + kSwatch, middle.y()}}, {layer.color, layer.size, layer.dashed});
    else if (layer.kind == Layer::kDots)
      canvas->dot(middle, std::min(layer.size, kLine / 2 - 3), layer.color);
    else
      canvas->fill({x + 3, y + 3, kSwatch - 6, kLine - 6}, layer.color);
    canvas->text({x + kSwatch + 6, y + kLine - 4}, layer.name, Anchor::kStart);
    x += width;
  }
  return any ? y + kLine - box.top : 0;
}

void drawAxes(const Chart& chart, const ChartScale& scale, Canvas* canvas) {
  const Box& plot = scale.plot();
  const std::vector<double> xs = ticksOf(scale.x(), static_cast<int>(plot.width / kTickDistance));
  for (const double x : xs) {
    const double u = scale.pixel({x, scale.y().from}).x();
    canvas->line({{u, plot.top}, {u, plot.bottom()}}, {kGrid});
    canvas->text({u, plot.bottom() + kLine}, tickText(x, xs.size() > 1 ? xs[1] - xs[0] : 1), Anchor::kMiddle);
  }
  canvas->text({plot.left + plot.width / 2, plot.bottom() + 2 * kLine}, chart.x_label, Anchor::kMiddle);
  std::vector<double> ys = ticksOf(scale.y(), static_cast<int>(plot.height / (0.6 * kTickDistance)));
  if (!chart.rows.empty()) ys.clear();
  for (const double y : ys) {
    const double v = scale.pixel({scale.x().from, y}).y();
    canvas->line({{plot.left, v}, {plot.right(), v}}, {kGrid});
    canvas->text({plot.left - 6, v + 4}, tickText(y, ys.size() > 1 ? ys[1] - ys[0] : 1), Anchor::kEnd);
  }
  for (std::size_t i = 0; i < chart.rows.size(); ++i)
    canvas->text({plot.left - 6, scale.pixel({scale.x().from, static_cast<double>(i)}).y() + 4}, chart.rows[i], Anchor::kEnd);
}

void drawFrame(const Box& plot, Canvas* canvas) {
  canvas->line({{plot.left, plot.top},
                {plot.right(), plot.top},
                {plot.right(), plot.bottom()},
                {plot.left, plot.bottom()},
                {plot.left, plot.top}},
               {kFrame});
}

/// Lines are interrupted at points that are not finite.
void drawLine(const Layer& layer, const ChartScale& scale, Canvas* canvas) {
  std::vector<Eigen::Vector2d> piece;
  const auto flush = [&] {
    if (piece.size() > 1) canvas->line(piece, {layer.color, layer.size, layer.dashed});
    piece.clear();
  };
  for (const Eigen::Vector2d& point : layer.points) {
    if (point.allFinite())
      piece.push_back(scale.pixel(point));
    else
      flush();
  }
  flush();
}

void drawBars(const Layer& layer, const ChartScale& scale, Canvas* canvas) {
  const Box& plot = scale.plot();
  const Eigen::Vector2d least(plot.left, plot.top), most(plot.right(), plot.bottom());
  for (std::size_t i = 0; 2 * i + 1 < layer.points.size(); ++i) {
    const Eigen::Vector2d a = scale.pixel(layer.points[2 * i]), b = scale.pixel(layer.points[2 * i + 1]);
    if (!a.allFinite() || !b.allFinite()) continue;
    const Eigen::Vector2d from = a.cwiseMin(b).cwiseMax(least), to = a.cwiseMax(b).cwiseMin(most);
    if ((to - from).minCoeff() > 0)
      canvas->fill({from.x(), from.y(), to.x() - from.x(), to.y() - from.y()},
                   i < layer.colors.size() ? layer.colors[i] : layer.color);
  }
}

void drawLayer(const Layer& layer, const ChartScale& scale, Canvas* canvas) {
  if (layer.kind == Layer::kLine) return drawLine(layer, scale, canvas);
  if (layer.kind == Layer::kBars) return drawBars(layer, scale, canvas);
  for (std::size_t i = 0; i < layer.points.size(); ++i)
    if (layer.points[i].allFinite())
      canvas->dot(scale.pixel(layer.points[i]), layer.size, i < layer.colors.size() ? layer.colors[i] : layer.color);
}

}  // namespace

ChartScale::ChartScale(const Chart& chart, const Box& plot)
    : plot_(plot),
      x_(chart.x.value_or(rangeOf(chart, 0))),
      y_(chart.y.value_or(rangeOf(chart, 1))),
      y_down_(chart.y_down || !chart.rows.empty()) {
  if (!chart.rows.empty()) y_ = {-0.5, static_cast<double>(chart.rows.size()) - 0.5};
  if (!chart.equal_scales) return;
  const double per_pixel = std::max(x_.span() / plot.width, y_.span() / plot.height);
  x_ = widened(x_, per_pixel * plot.width);
  y_ = widened(y_, per_pixel * plot.height);
}

Eigen::Vector2d ChartScale::pixel(const Eigen::Vector2d& point) const {
  const double u = (point.x() - x_.from) / x_.span(), v = (point.y() - y_.from) / y_.span();
  return {plot_.left + u * plot_.width, plot_.top + (y_down_ ? v : 1 - v) * plot_.height};
}

std::vector<double> ticksOf(const Range& range, int most) {
  const double least_step = range.span() / std::max(most, 1);
  double step = std::pow(10, std::floor(std::log10(least_step)));
  for (const double factor : {1, 2, 5, 10}) {
    if (factor * step < least_step * (1 - 1e-9)) continue;
    step *= factor;
    break;
  }
  std::vector<double> ticks;
  for (double i = std::ceil(range.from / step - 1e-9); i * step <= range.to + 1e-9 * step; ++i) ticks.push_back(i * step);
  return ticks;
}

ChartScale drawChart(const Chart& chart, const Box& box, Canvas* canvas) {
  double room = kLabelRoom;
  for (const std::string& row : chart.rows) room = std::max(room, canvas->widthOf(row) + 12);
  canvas->text({box.left + room, box.top + kLine - 4}, chart.title, Anchor::kStart, true);
  double top = box.top + kLine + 2;
  top += drawLegend(chart, {box.left + room, top, box.width - room - 12, 0}, canvas) + 4;
  if (!chart.y_label.empty()) top += kLine;
  canvas->text({box.left + 4, top - 6}, chart.y_label, Anchor::kStart);
  const ChartScale scale(chart, {box.left + room, top, box.width - room - 12, box.bottom() - 2 * kLine - 6 - top});
  drawAxes(chart, scale, canvas);
  for (const Layer& layer : chart.layers) drawLayer(layer, scale, canvas);
  drawFrame(scale.plot(), canvas);
  return scale;
}

}  // namespace cabinet_articulation
