// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tools/report/canvas.h"

namespace cabinet_articulation {

/// With &, <, > and quotes as entities, for HTML and SVG.
std::string escaped(const std::string& text);

/// Draws an SVG element for a page of HTML.
class SvgCanvas : public Canvas {
 public:
  SvgCanvas(double width, double height) : width_(width), height_(height) {}

  void line(const std::vector<Eigen::Vector2d>& points, const Stroke& stroke) override;
  void fill(const Box& box, const Color& color) override;
  void dot(const Eigen::Vector2d& center, double radius, const Color& color) override;
  void text(const Eigen::Vector2d& at, const std::string& words, Anchor anchor, bool bold) override;
  double widthOf(const std::string& words) const override;  ///< about: it depends on the reader's font

  /// `description` is for those who cannot see it.
  std::string element(const std::string& description) const;

 private:
  double width_, height_;
  std::string content_;
};

}  // namespace cabinet_articulation
