// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/svg_canvas.h"

#include <cmath>

#include "tools/terminal/words.h"

namespace cabinet_articulation {
namespace {

std::string colorText(const Color& color) {
  const auto byte = [&color](std::size_t i) { return static_cast<unsigned>(std::lround(255 * color[i])); };
  return format("#%02x%02x%02x", byte(0), byte(1), byte(2));
}

const char* anchorText(Anchor anchor) {
  if (anchor == Anchor::kStart) return "start";
  return anchor == Anchor::kMiddle ? "middle" : "end";
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

void SvgCanvas::line(const std::vector<Eigen::Vector2d>& points, const Stroke& stroke) {
  content_ += "<polyline points=\"";
  for (const Eigen::Vector2d& p : points) content_ += format("%.1f,%.1f ", p.x(), p.y());
  content_ += format("\" fill=\"none\" stroke=\"%s\" stroke-width=\"%.1f\"%s/>\n", colorText(stroke.color).c_str(), stroke.width,
                     stroke.dashed ? " stroke-dasharray=\"5 4\"" : "");
}

void SvgCanvas::fill(const Box& box, const Color& color) {
  content_ += format("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\"/>\n", box.left, box.top, box.width,
                     box.height, colorText(color).c_str());
}

void SvgCanvas::dot(const Eigen::Vector2d& center, double radius, const Color& color) {
  content_ += format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"%s\"/>\n", center.x(), center.y(), radius,
                     colorText(color).c_str());
}

void SvgCanvas::text(const Eigen::Vector2d& at, const std::string& words, Anchor anchor, bool bold) {
  content_ += format("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\"%s>", at.x(), at.y(), anchorText(anchor),
                     bold ? " font-weight=\"bold\"" : "") +
              escaped(words) + "</text>\n";
}

double SvgCanvas::widthOf(const std::string& words) const {
  constexpr double kLetter = 6.3;  // of a sans-serif font of 12 px
  return kLetter * static_cast<double>(words.size());
}

std::string SvgCanvas::element(const std::string& description) const {
  return format("<svg viewBox=\"0 0 %.0f %.0f\" width=\"%.0f\" height=\"%.0f\" font-size=\"12\" role=\"img\">\n", width_, height_,
                width_, height_) +
         "<title>" + escaped(description) + "</title>\n" + content_ + "</svg>\n";
}

}  // namespace cabinet_articulation
