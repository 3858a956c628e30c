// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/html.h"

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>

#include "tools/report/svg_canvas.h"

namespace cabinet_articulation {
namespace {

constexpr char kStyle[] = R"(
body { font: 15px/1.45 sans-serif; color: #222; max-width: 1120px; margin: 24px auto; padding: 0 16px; }
h1 { font-size: 26px; margin-bottom: 4px; }
h2 { font-size: 20px; margin: 36px 0 8px; border-bottom: 2px solid #0072b2; padding-bottom: 4px; }
h3 { font-size: 16px; margin: 16px 0 6px; }
table { border-collapse: collapse; }
th, td { text-align: left; padding: 4px 14px 4px 0; border-bottom: 1px solid #ddd; vertical-align: top; }
th { font-weight: 600; }
.facts th { white-space: nowrap; color: #555; }
.row { display: flex; flex-wrap: wrap; gap: 16px; align-items: flex-start; }
.frames { display: grid; grid-template-columns: repeat(4, 1fr); gap: 10px; }
.frames details[open] { grid-column: 1 / -1; }
.frames summary { list-style: none; cursor: zoom-in; }
.frames details[open] summary { cursor: zoom-out; }
.frames img { width: 100%; display: block; }
.left { width: 560px; }
.right { width: 540px; }
.right img { width: 100%; }
figure { margin: 0; }
figcaption, .note { color: #555; font-size: 13px; }
code { background: #f2f2f2; padding: 1px 4px; overflow-wrap: anywhere; }
svg { max-width: 100%; height: auto; font-family: sans-serif; fill: #222; }
.swatch { display: inline-block; width: 11px; height: 11px; margin-right: 6px; }
)";

std::string base64(const std::vector<std::uint8_t>& bytes) {
  using boost::archive::iterators::base64_from_binary;
  using boost::archive::iterators::transform_width;
  using Letters = base64_from_binary<transform_width<const std::uint8_t*, 6, 8>>;
  std::string text(Letters(bytes.data()), Letters(bytes.data() + bytes.size()));
  text.append((4 - text.size() % 4) % 4, '=');
  return text;
}

}  // namespace

std::string document(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width\"/>\n" +
         element("title", title) + "<style>" + kStyle + "</style>\n</head>\n<body>\n" + body + "</body>\n</html>\n";
}

std::string element(const std::string& name, const std::string& text) {
  return "<" + name + ">" + escaped(text) + "</" + name + ">\n";
}

std::string tableRow(const std::string& cell_name, const std::vector<std::string>& cells) {
  std::string row = "<tr>";
  for (const std::string& cell : cells) row += "<" + cell_name + ">" + cell + "</" + cell_name + ">";
  return row + "</tr>\n";
}

std::string factTable(const std::vector<std::pair<std::string, std::string>>& facts) {
  std::string table = "<table class=\"facts\">\n";
  for (const auto& [name, value] : facts) table += "<tr><th>" + escaped(name) + "</th><td>" + value + "</td></tr>\n";
  return table + "</table>\n";
}

std::string jpegElement(const std::vector<std::uint8_t>& jpeg, const std::string& description) {
  return "<img alt=\"" + escaped(description) + "\" src=\"data:image/jpeg;base64," + base64(jpeg) + "\"/>";
}

std::string chartElement(const Chart& chart, double width, double height) {
  SvgCanvas canvas(width, height);
  drawChart(chart, {0, 0, width, height}, &canvas);
  return canvas.element(chart.title);
}

}  // namespace cabinet_articulation
