// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "tools/report/canvas.h"

namespace cabinet_articulation {

/// Data of one kind in a chart, in the chart's units.
struct Layer {
  enum Kind { kLine, kDots, kBars };

  Kind kind = kLine;
  std::string name;  ///< in the legend; empty: not there
  Color color{};
  double size = 1;  ///< [px] width of a line, radius of a dot
  bool dashed = false;
  std::vector<Eigen::Vector2d> points{};  ///< of bars: two opposite corners each
  std::vector<Color> colors{};            ///< of each dot or bar, in place of `color`
  bool sets_range = true;                 ///< false: cut off where the other layers end
};

struct Range {
  double from = 0, to = 0;

  double span() const { return to - from; }
};

/// Layers are drawn in their order.
struct Chart {
  std::string title, x_label, y_label;
  std::vector<Layer> layers;
  std::optional<Range> x, y;      ///< without them: that of the layers
  std::vector<std::string> rows;  ///< names for y = 0, 1, ... from top to bottom; empty: numbers
  bool equal_scales = false;      ///< a metre is as long in both directions
  bool y_down = false;
};

/// Where the data of a chart lie on a canvas.
class ChartScale {
 public:
  /// `plot` is the area within the axes.
  ChartScale(const Chart& chart, const Box& plot);

  Eigen::Vector2d pixel(const Eigen::Vector2d& point) const;
  const Box& plot() const { return plot_; }
  const Range& x() const { return x_; }
  const Range& y() const { return y_; }

 private:
  Box plot_;
  Range x_, y_;
  bool y_down_;
};

/// Multiples of 1, 2 or 5 times a power of ten within the range, `most` at most.
std::vector<double> ticksOf(const Range& range, int most);

/// Draws title, legend, axes and layers into the box. Returns the scale, for tests.
ChartScale drawChart(const Chart& chart, const Box& box, Canvas* canvas);

}  // namespace cabinet_articulation
