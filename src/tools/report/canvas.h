// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "ros/drawing/model_drawing.h"

namespace cabinet_articulation {

/// [px] from the upper left corner, x to the right, y down.
struct Box {
  double left = 0, top = 0, width = 0, height = 0;

  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

struct Stroke {
  Color color{};
  double width = 1;  ///< [px]
  bool dashed = false;
};

enum class Anchor { kStart, kMiddle, kEnd };

/// What charts are drawn on: a page, or a picture. Points in pixels, as in Box.
class Canvas {
 public:
  virtual ~Canvas() = default;

  virtual void line(const std::vector<Eigen::Vector2d>& points, const Stroke& stroke) = 0;
  virtual void fill(const Box& box, const Color& color) = 0;
  virtual void dot(const Eigen::Vector2d& center, double radius, const Color& color) = 0;

  /// ASCII. `at` is on the base line, at the text's start, middle or end.
  virtual void text(const Eigen::Vector2d& at, const std::string& words, Anchor anchor, bool bold = false) = 0;

  /// [px]
  virtual double widthOf(const std::string& words) const = 0;
};

}  // namespace cabinet_articulation
